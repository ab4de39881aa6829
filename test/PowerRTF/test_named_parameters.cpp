// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Chains of named parameters: any order, and chains of CGAL's own.
#include <CGAL/PowerRTF/named_parameters.h>

#include <doctest/doctest.h>

#include <functional>

using namespace CGAL::PowerRTF;
namespace params = CGAL::PowerRTF::parameters;

namespace {

// Values by which the parameters are known again; none converts to another.
struct Points {
  int id = 1;
};
struct Creases {
  int id = 2;
};
struct Corners {
  int id = 9;
};
struct Densities {
  int id = 3;
};
struct Traits {
  int id = 4;
};
struct Visitor {
  int id = 5;
};

Remeshing_options with_power(double power)
{
  Remeshing_options options;
  options.density_power = power;
  return options;
}

template <class Tag, class Chain>
auto value(const Chain& chain)
{
  return CGAL::parameters::get_parameter(chain, Tag());
}

template <class Chain>
void check_cgal_parameters(const Chain& chain)
{
  CHECK(value<CGAL::internal_np::vertex_point_t>(chain).id == 1);
  CHECK(value<CGAL::internal_np::edge_is_constrained_t>(chain).id == 2);
  CHECK(value<CGAL::internal_np::geom_traits_t>(chain).id == 4);
  CHECK(value<CGAL::internal_np::visitor_t>(chain).id == 5);
  CHECK(value<CGAL::internal_np::random_seed_t>(chain) == 6);
  CHECK(value<CGAL::internal_np::number_of_iterations_t>(chain) == 7);
  CHECK(value<CGAL::internal_np::vertex_is_constrained_t>(chain).id == 9);
}

template <class Chain>
void check_own_parameters(const Chain& chain)
{
  CHECK(value<internal::density_map_t>(chain).id == 3);
  CHECK(value<internal::remeshing_options_t>(chain).density_power == 8);
  CHECK(value<internal::repair_t>(chain) == Repair::no);
}

template <class Tag, class Chain>
constexpr bool has()
{
  return !std::is_same<typename CGAL::internal_np::Get_param<typename Chain::base, Tag>::type,
                       CGAL::internal_np::Param_not_found>::value;
}

} // namespace

TEST_CASE("chains take all parameters in any order, and begin with any")
{
  const Remeshing_options options = with_power(8);
  const auto check = [](const auto& chain) {
    check_cgal_parameters(chain);
    check_own_parameters(chain);
  };
  check(params::vertex_point_map(Points())
            .density_map(Densities())
            .edge_is_constrained_map(Creases())
            .vertex_is_constrained_map(Corners())
            .geom_traits(Traits())
            .remeshing_options(options)
            .visitor(Visitor())
            .random_seed(6)
            .repair(false)
            .number_of_iterations(7));
  check(params::edge_is_constrained_map(Creases())
            .vertex_is_constrained_map(Corners())
            .remeshing_options(options)
            .random_seed(6)
            .density_map(Densities())
            .number_of_iterations(7)
            .vertex_point_map(Points())
            .repair(false)
            .visitor(Visitor())
            .geom_traits(Traits()));
  check(params::geom_traits(Traits())
            .visitor(Visitor())
            .random_seed(6)
            .number_of_iterations(7)
            .vertex_point_map(Points())
            .edge_is_constrained_map(Creases())
            .vertex_is_constrained_map(Corners())
            .density_map(Densities())
            .remeshing_options(options)
            .repair(false));
  check(params::visitor(Visitor())
            .repair(false)
            .geom_traits(Traits())
            .remeshing_options(options)
            .vertex_point_map(Points())
            .density_map(Densities())
            .edge_is_constrained_map(Creases())
            .vertex_is_constrained_map(Corners())
            .number_of_iterations(7)
            .random_seed(6));
  check(params::random_seed(6)
            .number_of_iterations(7)
            .repair(false)
            .visitor(Visitor())
            .density_map(Densities())
            .geom_traits(Traits())
            .vertex_point_map(Points())
            .remeshing_options(options)
            .edge_is_constrained_map(Creases())
            .vertex_is_constrained_map(Corners()));
  check(params::number_of_iterations(7)
            .density_map(Densities())
            .repair(false)
            .random_seed(6)
            .remeshing_options(options)
            .edge_is_constrained_map(Creases())
            .vertex_is_constrained_map(Corners())
            .visitor(Visitor())
            .geom_traits(Traits())
            .vertex_point_map(Points()));
  check(params::density_map(Densities())
            .vertex_point_map(Points())
            .repair(false)
            .edge_is_constrained_map(Creases())
            .vertex_is_constrained_map(Corners())
            .remeshing_options(options)
            .geom_traits(Traits())
            .visitor(Visitor())
            .random_seed(6)
            .number_of_iterations(7));
  check(params::remeshing_options(options)
            .density_map(Densities())
            .repair(false)
            .random_seed(6)
            .number_of_iterations(7)
            .visitor(Visitor())
            .geom_traits(Traits())
            .edge_is_constrained_map(Creases())
            .vertex_is_constrained_map(Corners())
            .vertex_point_map(Points()));
  check(params::repair(false)
            .number_of_iterations(7)
            .random_seed(6)
            .visitor(Visitor())
            .geom_traits(Traits())
            .edge_is_constrained_map(Creases())
            .vertex_is_constrained_map(Corners())
            .vertex_point_map(Points())
            .density_map(Densities())
            .remeshing_options(options));
}

TEST_CASE("the last of several values counts; what is not given is not found")
{
  const auto chain = params::random_seed(1).density_map(Densities()).random_seed(2);
  CHECK(value<CGAL::internal_np::random_seed_t>(chain) == 2);
  CHECK(has<internal::density_map_t, decltype(chain)>());
  CHECK_FALSE(has<internal::repair_t, decltype(chain)>());
  CHECK_FALSE(has<CGAL::internal_np::visitor_t, decltype(chain)>());
  CHECK(internal::has_input_parameter<decltype(chain)>());
  CHECK_FALSE(internal::has_input_parameter<decltype(params::random_seed(1))>());
  CHECK_FALSE(internal::has_input_parameter<decltype(params::default_values())>());
}

TEST_CASE("references stay references")
{
  Visitor visitor;
  const auto chain = params::visitor(std::ref(visitor)).repair(false);
  CGAL::parameters::get_parameter_reference(chain, CGAL::internal_np::visitor).id = 77;
  CHECK(visitor.id == 77);
}

TEST_CASE("CGAL's chains are combined with ours, either first")
{
  namespace cgal = CGAL::parameters;
  const auto theirs = cgal::vertex_point_map(Points())
                          .edge_is_constrained_map(Creases())
                          .vertex_is_constrained_map(Corners())
                          .geom_traits(Traits())
                          .visitor(Visitor())
                          .random_seed(6)
                          .number_of_iterations(7);
  const auto ours = params::density_map(Densities()).remeshing_options(with_power(8)).repair(false);
  const auto check = [](const auto& chain) {
    check_cgal_parameters(chain);
    check_own_parameters(chain);
  };
  check(params::combine(theirs, ours));
  check(params::combine(ours, theirs));
  check(params::combine(params::combine(theirs, params::density_map(Densities())).repair(false),
                        params::remeshing_options(with_power(8))));
  CHECK(value<CGAL::internal_np::random_seed_t>(
            params::combine(cgal::random_seed(1), cgal::random_seed(2))) == 2);

  Visitor visitor;
  const auto chain = params::combine(cgal::visitor(std::ref(visitor)), ours);
  CGAL::parameters::get_parameter_reference(chain, CGAL::internal_np::visitor).id = 78;
  CHECK(visitor.id == 78);
  check_own_parameters(params::combine(cgal::default_values(), ours));
}

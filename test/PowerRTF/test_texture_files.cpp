// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Textures from file to file: read, kept along their seams, written.
#include "mesh_data.h"
#include "remesh_file.h"
#include "shapes.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>

using namespace mesh_data;
using namespace tools;
using CGAL::PowerRTF::Triangle;

namespace {

namespace fs = std::filesystem;
using Uv = std::array<double, 2>;
using Chart_map = std::function<Uv(int chart, const Vec3d& p)>;

constexpr double pi = 3.14159265358979323846;

/// Facets with a chart each, and the map of the charts.
struct Textured {
  shapes::Soup soup;
  std::vector<int> charts;
  Chart_map map;
};

/// A cube with a chart for each side, of other sizes and the other way round.
Textured cube()
{
  Textured t;
  t.soup = shapes::box(4);
  for (const Triangle& f : t.soup.triangles) {
    const Vec3d n =
        cross(t.soup.points[f[1]] - t.soup.points[f[0]], t.soup.points[f[2]] - t.soup.points[f[0]]);
    const double xyz[] = {n.x, n.y, n.z};
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(xyz[axis]) > 1e-9) t.charts.push_back(2 * axis + (xyz[axis] > 0));
  }
  t.map = [](int chart, const Vec3d& p) {
    const double a = chart / 2 == 0 ? p.y : p.x, b = chart / 2 == 2 ? p.y : p.z;
    return Uv{chart * 10 + (chart + 1) * a, chart * 10 + b};
  };
  return t;
}

/// An open cylinder with one chart, cut along a line, where u jumps from 2 pi to 0.
Textured cylinder(int around)
{
  Textured t;
  t.soup = shapes::open_cylinder(around, around / 4, 1, 2);
  t.charts.assign(t.soup.triangles.size(), 0);
  t.map = [](int, const Vec3d& p) {
    const double angle = std::atan2(p.y, p.x);
    return Uv{angle < -1e-9 ? angle + 2 * pi : std::max(angle, 0.), p.z};
  };
  return t;
}

/// The coordinates of the corners of a facet, all on one side of a cut.
std::array<Uv, 3> mapped(const Textured& t, int chart, const std::array<Vec3d, 3>& corners)
{
  std::array<Uv, 3> uv;
  for (int i = 0; i < 3; ++i) uv[i] = t.map(chart, corners[i]);
  const double most = std::max({uv[0][0], uv[1][0], uv[2][0]});
  for (Uv& x : uv)
    if (most - x[0] > pi && t.charts.back() == 0) x[0] += 2 * pi;
  return uv;
}

std::string obj_of(const Textured& t)
{
  std::ostringstream out;
  out.precision(17);
  for (const Vec3d& p : t.soup.points) out << "v " << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (std::size_t f = 0; f < t.charts.size(); ++f) {
    const Triangle& v = t.soup.triangles[f];
    const auto& p = t.soup.points;
    for (const Uv& uv : mapped(t, t.charts[f], {p[v[0]], p[v[1]], p[v[2]]}))
      out << "vt " << uv[0] << ' ' << uv[1] << '\n';
    out << "f " << v[0] + 1 << "/-3 " << v[1] + 1 << "/-2/ " << v[2] + 1 << "/-1\n";
  }
  return out.str();
}

/// A folder that goes with it.
struct Scratch {
  fs::path path = fs::temp_directory_path() / ("power_rtf_texture_" + std::to_string(::getpid()));
  Scratch() { fs::create_directories(path); }
  ~Scratch() { fs::remove_all(path); }
};

/// What the program makes of an OBJ file.
struct Remeshed {
  Polygon_mesh mesh;
  Run run;
};
Remeshed remeshed(const std::string& obj, std::size_t n, Program_options options = {},
                  const std::string& format = "obj")
{
  const Scratch scratch;
  options.input = (scratch.path / "input.obj").string();
  options.output = (scratch.path / ("output." + format)).string();
  std::ofstream(options.input) << obj;
  options.remeshing.number_of_samples = n;
  options.traits = "cpu";
  options.quiet = true;
  options.keeps_texture = true;
  Remeshed result;
  result.run = remesh_file(options, 0);
  result.mesh = read_mesh(options.output);
  return result;
}

/// Corner `i` of facet `f`.
Uv uv_of(const Polygon_mesh& mesh, std::size_t f, int i)
{
  const Texture& texture = mesh.properties.texture;
  return texture.coordinates[texture.corners[3 * f + i]];
}

std::array<Vec3d, 3> corners_of(const Polygon_mesh& mesh, std::size_t f)
{
  const auto corner = [&](int i) { return mesh.soup.points[mesh.soup.corners[3 * f + i]]; };
  return {corner(0), corner(1), corner(2)};
}

double area(const std::array<Uv, 3>& t)
{
  return std::abs((t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) -
                  (t[1][1] - t[0][1]) * (t[2][0] - t[0][0])) /
         2;
}

/// By chart the area in the texture.
std::vector<double> chart_areas(const Textured& t)
{
  std::vector<double> areas(6, 0);
  for (std::size_t f = 0; f < t.charts.size(); ++f) {
    const Triangle& v = t.soup.triangles[f];
    const auto& p = t.soup.points;
    areas[t.charts[f]] += area(mapped(t, t.charts[f], {p[v[0]], p[v[1]], p[v[2]]}));
  }
  return areas;
}

/// The largest distance of a corner's coordinates from those of its chart there; the areas of the
/// charts are right within 1 %.
double check_charts(const Textured& t, const Polygon_mesh& mesh)
{
  REQUIRE(mesh.properties.texture.corners.size() == mesh.soup.corners.size());
  double error = 0;
  std::vector<double> areas(6, 0);
  for (std::size_t f = 0; f + 1 < mesh.soup.first.size(); ++f) {
    const std::array<Uv, 3> uv = {uv_of(mesh, f, 0), uv_of(mesh, f, 1), uv_of(mesh, f, 2)};
    const int chart =
        t.charts.back() == 0 ? 0 : int(std::floor((uv[0][1] + uv[1][1] + uv[2][1]) / 30 + 0.5));
    REQUIRE(chart >= 0);
    REQUIRE(chart < 6);
    areas[chart] += area(uv);
    const std::array<Uv, 3> wanted = mapped(t, chart, corners_of(mesh, f));
    for (int i = 0; i < 3; ++i)
      error = std::max(error, std::hypot(uv[i][0] - wanted[i][0], uv[i][1] - wanted[i][1]));
  }
  const std::vector<double> wanted = chart_areas(t);
  for (int chart = 0; chart < 6; ++chart)
    CHECK(areas[chart] == doctest::Approx(wanted[chart]).epsilon(0.01));
  return error;
}

/// How many coordinates the vertices have, all in all.
std::size_t count_pairs(const Polygon_mesh& mesh)
{
  std::set<std::pair<int, int>> pairs;
  for (std::size_t c = 0; c < mesh.soup.corners.size(); ++c)
    pairs.emplace(mesh.soup.corners[c], mesh.properties.texture.corners[c]);
  return pairs.size();
}

} // namespace

TEST_CASE("flat charts come over as they are, each vertex of a seam has a place in each chart")
{
  const Textured t = cube();
  const auto [mesh, run] = remeshed(obj_of(t), 500);
  CHECK(run.report.lost_feature_edges == 0);
  CHECK(run.not_carried_over.empty());
  CHECK(check_charts(t, mesh) < 1e-5); // of 60, in single precision
  std::size_t pairs = 0;
  for (const Vec3d& p : mesh.soup.points) {
    int sides = 0;
    for (const double x : {p.x, p.y, p.z}) sides += std::abs(x) > 1 - 1e-9;
    pairs += sides;
  }
  CHECK(count_pairs(mesh) == pairs);
}

TEST_CASE("PLY holds them, too, as text and binary")
{
  const Textured t = cube();
  Program_options options;
  for (const Encoding encoding : {Encoding::text, Encoding::binary}) {
    options.encoding = encoding;
    const Remeshed r = remeshed(obj_of(t), 500, options, "ply");
    CHECK((r.run.not_carried_over.empty() && check_charts(t, r.mesh) < 1e-5));
  }
}

TEST_CASE("a cut through a smooth surface is kept, and the error is of second order")
{
  const auto error = [](int around, std::size_t n) {
    const Textured t = cylinder(around);
    const auto [mesh, run] = remeshed(obj_of(t), n);
    CHECK(run.report.lost_feature_edges == 0);
    std::size_t on_cut = 0;
    for (const Vec3d& p : mesh.soup.points) on_cut += p.x > 0 && std::abs(p.y) < 1e-9;
    CHECK(on_cut > 3);
    CHECK(count_pairs(mesh) == mesh.soup.points.size() + on_cut);
    return check_charts(t, mesh);
  };
  const double coarse = error(24, 300), fine = error(96, 4800);
  CHECK(fine < coarse / 8);
  CHECK(fine > 0);
}

TEST_CASE("a part that stays keeps its coordinates, and the rest has its own beside it")
{
  const Textured t = cube();
  std::string obj = obj_of(t), with_groups;
  std::size_t f = 0;
  for (std::size_t begin = 0; begin < obj.size();) {
    const std::size_t end = obj.find('\n', begin) + 1;
    if (obj[begin] == 'f') with_groups += t.charts[f++] < 3 ? "g stays\n" : "g goes\n";
    with_groups += obj.substr(begin, end - begin);
    begin = end;
  }
  Program_options options;
  options.region_name = "group";
  options.region_value = "goes";
  const auto [mesh, run] = remeshed(with_groups, 300, options);
  CHECK(run.report.kept_faces > 0);
  CHECK(check_charts(t, mesh) < 1e-5);
}

TEST_CASE("materials come with their files, whose names are as seen from the output")
{
  const std::string square = "mtllib a b.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\n"
                             "vt 1 1\nvt 0 1 0\nusemtl red\nf 1/1 2/2 3/3\nusemtl blue\n"
                             "f 1/1 3/3 4/4\n";
  const Polygon_mesh mesh = remeshed(square, 100).mesh;
  CHECK(mesh.properties.material_files == std::vector<std::string>{"a b.mtl"});
  const Mesh_property& material = mesh.properties.faces.at(0);
  CHECK(material.names.size() == 2);
  for (std::size_t f = 0; f < material.values.size(); ++f) {
    const auto p = corners_of(mesh, f);
    const bool is_red = material.names[int(material.values[f])] == "red";
    for (const Vec3d& q : p) CHECK((is_red ? q.x - q.y : q.y - q.x) > -1e-9); // the diagonal stays
  }

  const Scratch scratch;
  fs::create_directories(scratch.path / "out");
  Program_options options;
  options.input = (scratch.path / "a.obj").string();
  options.output = (scratch.path / "out" / "b.obj").string();
  std::ofstream(options.input) << square;
  options.remeshing.number_of_samples = 50;
  options.traits = "cpu";
  options.quiet = options.keeps_texture = true;
  remesh_file(options, 0);
  CHECK(read_mesh(options.output).properties.material_files ==
        std::vector<std::string>{"../a b.mtl"});
}

TEST_CASE("the materials of an OBJ file and their images go into a glTF file")
{
  const Scratch scratch;
  const auto file = [&](const std::string& name) { return (scratch.path / name).string(); };
  std::ofstream(file("a.mtl")) << "newmtl red\nKd 1 0.5 0\nd 0.25\nmap_Kd wood grain.png\n"
                                  "newmtl none\nmap_Kd nowhere.png\n";
  std::ofstream(file("wood grain.png")) << "the bytes of an image";
  std::ofstream(file("a.obj")) << "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\n"
                                  "usemtl none\nf 1/1 2/1 3/1\nusemtl red\nf 1/1 3/1 4/1\n";
  Program_options options;
  options.input = file("a.obj");
  options.output = file("a.glb");
  options.remeshing.number_of_samples = 50;
  options.traits = "cpu";
  options.quiet = options.keeps_texture = true;
  CHECK(remesh_file(options, 0).not_carried_over.empty());
  const Mesh_properties properties = read_mesh(options.output).properties;
  CHECK(properties.faces.at(0).names == std::vector<std::string>{"none", "red"});
  CHECK(properties.gltf_materials.images == std::vector<std::string>{"the bytes of an image"});
  const std::string& json = properties.gltf_materials.json;
  CHECK(json.find("[1.0,0.5,0.0,0.25]") != std::string::npos);
  CHECK(json.find("nowhere") == std::string::npos);

  fs::remove(file("a.mtl"));
  CHECK(remesh_file(options, 0).not_carried_over ==
        std::vector<std::string>{"the look of materials"});
}

TEST_CASE("the materials and images of a glTF file go to OBJ and PLY, in files beside these")
{
  const Scratch scratch;
  const auto file = [&](const std::string& name) { return (scratch.path / name).string(); };
  const auto content = [&](const std::string& name) {
    std::ifstream in(file(name), std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  };
  Mesh_properties properties;
  properties.texture = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {0, 1, 2, 0, 2, 3}};
  properties.faces = {{"material", Number_type::int32, {0, 1}, {"wood", "glass"}}};
  properties.gltf_materials = {
      R"({"materials":[{"name":"wood","pbrMetallicRoughness":{"baseColorTexture":{"index":1}}},)"
      R"({"name":"glass","pbrMetallicRoughness":{"baseColorFactor":[0,0.5,1,0.25],)"
      R"("baseColorTexture":{"index":0}}}],"textures":[{"source":1},{"source":0}],)"
      R"("images":[{"mimeType":"image/jpeg","bufferView":0},{"uri":"a%20b.png"}]})",
      {"the bytes of an image"}};
  {
    std::ofstream out(file("a.glb"), std::ios::binary);
    write_mesh(out, Format::glb, Encoding::binary, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
               {{{0, 1, 2}}, {{0, 2, 3}}}, properties);
  }
  Program_options options;
  options.input = file("a.glb");
  options.remeshing.number_of_samples = 50;
  options.traits = "cpu";
  options.quiet = options.keeps_texture = true;
  options.output = file("out.obj");
  CHECK(remesh_file(options, 0).not_carried_over.empty());
  CHECK(content("out.mtl") == "newmtl wood\nKd 1 1 1\nmap_Kd out_0.jpg\n"
                              "newmtl glass\nKd 0 0.5 1\nd 0.25\nmap_Kd a b.png\n");
  CHECK(content("out_0.jpg") == "the bytes of an image");
  const Polygon_mesh obj = read_mesh(options.output);
  CHECK(obj.properties.material_files == std::vector<std::string>{"out.mtl"});
  CHECK(obj.properties.faces.at(0).names == std::vector<std::string>{"wood", "glass"});

  options.output = file("side.ply");
  CHECK(remesh_file(options, 0).not_carried_over ==
        std::vector<std::string>{"names of materials", "the look of materials"});
  CHECK(content("side_0.jpg") == "the bytes of an image");
  const Polygon_mesh ply = read_mesh(options.output);
  CHECK(ply.properties.texture_files == std::vector<std::string>{"side_0.jpg", "a b.png"});
  REQUIRE(ply.properties.faces.size() == 1);
  CHECK(ply.properties.faces[0].names == ply.properties.texture_files);
  for (std::size_t f = 0; f + 1 < ply.soup.first.size(); ++f) {
    const bool is_first = ply.properties.faces[0].values[f] == 0;
    for (const Vec3d& q : corners_of(ply, f)) CHECK((is_first ? q.x - q.y : q.y - q.x) > -1e-9);
  }

  std::ofstream(file("a b.png")) << "another image";
  options.input = file("side.ply");
  options.output = file("c.glb");
  CHECK(remesh_file(options, 0).not_carried_over.empty());
  CHECK(read_mesh(options.output).properties.gltf_materials.images ==
        std::vector<std::string>{"the bytes of an image", "another image"});
}

TEST_CASE("OBJ: texture coordinates come back as they were written")
{
  Mesh_properties properties;
  properties.texture = {{{0.25, 1. / 3}, {-2, 0.1}, {0.1f, 7}}, {0, 1, 2, 2, -1, 0}};
  std::ostringstream out;
  write_mesh(out, Format::obj, Encoding::text, points, {{{0, 1, 2}}, {{2, 1, 3}}}, properties);
  CHECK(out.str().find("vt 0.25 0.3333333333333333\nvt -2 0.1\nvt 0.1 7\n") != std::string::npos);
  CHECK(out.str().find("f 3/3 2 4/1\n") != std::string::npos);
  const Polygon_mesh mesh = parse_mesh(Format::obj, out.str());
  CHECK(mesh.properties.texture.coordinates ==
        std::vector<Uv>{{0.25, 1. / 3}, {-2, 0.1}, {0.1, 7}}); // the shortest digits of 0.1f
  CHECK(mesh.properties.texture.corners == properties.texture.corners);
}

TEST_CASE("OBJ: texture coordinates that are wrong are told where they are wanted")
{
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\n";
  struct Case {
    std::string data, reason;
  };
  for (const Case& c :
       {Case{"vt 0 x\nf 1/1 2/1 3/1\n", "line 6: 'x' is not a number"},
        {"vt nan 0\nf 1/1 2/1 3/1\n", "line 6: 'nan' is not a finite number"},
        {"f 1/1 2/1 3/2\n", "line 6: '3/2' refers to texture coordinates that do not exist"},
        {"f 1/1 2/0 3/1\n", "line 6: '2/0' refers to texture coordinates that do not exist"},
        {"f 1/1 2/-2 3/1\n", "line 6: '2/-2' refers to texture coordinates that do not exist"},
        {"f 1/1 2/x 3/1\n", "line 6: '2/x' refers to texture coordinates that do not exist"}}) {
    CAPTURE(c.data);
    const Polygon_mesh mesh = parse_mesh(Format::obj, vertices + c.data);
    CHECK(mesh.texture_error == c.reason);
    CHECK(mesh.properties.texture.empty());
    CHECK_THROWS_WITH(remeshed(vertices + c.data, 50), doctest::Contains(c.reason.c_str()));
  }
  CHECK(parse_mesh(Format::obj, vertices + "f 1//1 2/1 3/\n").texture_error.empty());
}

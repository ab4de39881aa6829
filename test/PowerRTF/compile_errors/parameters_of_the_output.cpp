// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Must not compile: parameters about the input in the chain about the output.
#include <CGAL/power_rtf_remeshing.h>

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

int main()
{
  CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3> mesh;
  CGAL::power_rtf_remeshing(mesh, 100, mesh, CGAL::parameters::random_seed(3),
                            CGAL::PowerRTF::parameters::repair(false));
}

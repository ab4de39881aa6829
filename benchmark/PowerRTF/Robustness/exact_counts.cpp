// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the tests' judge, which shares no code with the package, counts in a mesh file with exact
// predicates: one line of JSON.
//
//   exact_counts FILE
#include "exact_judge.h"

#include <cstdlib>
#include <exception>
#include <iostream>

int main(int argc, char** argv)
{
  if (argc != 2) {
    std::cerr << "exact_counts FILE\n";
    return EXIT_FAILURE;
  }
  try {
    const judge::Mesh mesh = judge::read(argv[1]);
    const judge::Topology t = judge::topology(mesh);
    std::cout << "{\"vertices\": " << t.vertices << ", \"unused_vertices\": " << t.unused_vertices
              << ", \"faces\": " << t.facets << ", \"components\": " << t.components
              << ", \"border_loops\": " << t.border_loops
              << ", \"euler_characteristic\": " << t.euler_characteristic
              << ", \"sheets\": " << t.sheets
              << ", \"non_manifold_edges\": " << t.non_manifold_edges
              << ", \"non_manifold_vertices\": " << t.non_manifold_vertices
              << ", \"degenerate_facets\": " << judge::degenerate_facets(mesh)
              << ", \"self_intersections\": " << judge::self_intersections(mesh) << "}\n";
  } catch (const std::exception& e) {
    std::cerr << "exact_counts: " << e.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}

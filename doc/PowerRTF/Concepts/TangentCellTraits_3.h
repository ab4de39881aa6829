// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgPowerRTFConcepts
\cgalConcept

What the exact cells, `CGAL::PowerRTF::Exact_cells`, and their predicates ask of a kernel: its
types, the way from them to doubles, and an exact number type. The answers are exact for these
doubles.

\cgalHasModelsBegin
\cgalHasModels{`CGAL::PowerRTF::Tangent_cell_traits_3<Kernel>`}
\cgalHasModelsEnd
*/
class TangentCellTraits_3 {
public:
  /// The number type of the weights.
  typedef unspecified_type FT;
  /// The type of the samples.
  typedef unspecified_type Point_3;
  /// The type of the normals.
  typedef unspecified_type Vector_3;
  /// An exact ring, constructible from `double`, with `CGAL::sign()`: used where the interval
  /// filter cannot decide.
  typedef unspecified_type Exact_nt;

  /// The coordinates of a sample.
  CGAL::PowerRTF::Vec3d point(const Point_3& p) const;
  /// The coordinates of a normal, of any length but 0.
  CGAL::PowerRTF::Vec3d vector(const Vector_3& v) const;
  /// A weight.
  double weight(const FT& w) const;
};

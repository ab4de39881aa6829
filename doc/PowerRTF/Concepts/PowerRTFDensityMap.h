// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgPowerRTFConcepts
\cgalConcept

A density of the user's own: a `ReadablePropertyMap` from the vertices of the input to numbers, for
the named parameter `CGAL::PowerRTF::parameters::density_map()`. Between the vertices the density is
linear on each facet. Only ratios matter: where the density is 4 times as high, the samples are
twice as close. Its growth is limited by `CGAL::PowerRTF::Remeshing_options::gradation`; 0 takes it
as it is.

\cgalHasModelsBegin
\cgalHasModels{`CGAL::Surface_mesh<Point>::Property_map<Vertex_index, double>`}
\cgalHasModels{`boost::associative_property_map`, `boost::function_property_map` and any other
  property map with these types}
\cgalHasModelsEnd
*/
class PowerRTFDensityMap {
public:
  /// The vertices of the input mesh.
  typedef unspecified_type key_type;
  /// A number type; the values are positive and finite.
  typedef unspecified_type value_type;
  /// What `get()` returns.
  typedef unspecified_type reference;
  /// `boost::readable_property_map_tag` or one derived from it.
  typedef unspecified_type category;
};

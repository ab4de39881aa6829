// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Part of PowerRTF::core: the paper's extraction.
#include <CGAL/PowerRTF/extraction/extract_restricted_delaunay_impl.h>

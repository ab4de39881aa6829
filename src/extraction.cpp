// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Part of PowerRTF::core: from samples to triangles.
#include <CGAL/PowerRTF/extraction/Opened_surface_impl.h>
#include <CGAL/PowerRTF/extraction/extract_by_insertion_impl.h>

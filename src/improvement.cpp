// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Part of PowerRTF::core: rounder triangles, a mesh nearer to the surface, fewer vertices.
#include <CGAL/PowerRTF/improvement/coarsen_mesh_impl.h>
#include <CGAL/PowerRTF/improvement/improve_mesh_impl.h>

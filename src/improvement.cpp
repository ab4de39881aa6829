// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Part of PowerRTF::core: rounder triangles, and a mesh nearer to the surface.
#include <CGAL/PowerRTF/improvement/improve_mesh_impl.h>

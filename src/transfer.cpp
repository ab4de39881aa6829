// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Part of PowerRTF::core: where the result comes from.
#include <CGAL/PowerRTF/transfer/find_corner_sources_impl.h>
#include <CGAL/PowerRTF/transfer/find_sources_impl.h>

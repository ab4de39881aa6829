// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Part of PowerRTF::core: what the result is worth.
#include <CGAL/PowerRTF/quality/assess_impl.h>

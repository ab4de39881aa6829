// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What is compiled once: functions that no type of the user's reaches and that take long to compile
// are declared in a header `name.h` and defined in `name_impl.h`. The library PowerRTF::core has
// these definitions, and what links it has CGAL_POWER_RTF_COMPILED defined; otherwise `name.h`
// includes them.
#ifndef CGAL_POWER_RTF_INTERNAL_COMPILED_H
#define CGAL_POWER_RTF_INTERNAL_COMPILED_H

#ifdef CGAL_POWER_RTF_COMPILED
#define CGAL_POWER_RTF_INLINE
#else
#define CGAL_POWER_RTF_INLINE inline
#endif

#endif // CGAL_POWER_RTF_INTERNAL_COMPILED_H

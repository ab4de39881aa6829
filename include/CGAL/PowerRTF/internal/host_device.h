// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
//
// What marks functions for host and device.
#ifndef CGAL_POWER_RTF_INTERNAL_HOST_DEVICE_H
#define CGAL_POWER_RTF_INTERNAL_HOST_DEVICE_H

#ifdef __CUDACC__
#define CGAL_POWER_RTF_HD __host__ __device__
#else
#define CGAL_POWER_RTF_HD
#endif

/// Before a loop whose arrays must stay in registers.
#ifdef __CUDA_ARCH__
#define CGAL_POWER_RTF_UNROLL _Pragma("unroll")
#else
#define CGAL_POWER_RTF_UNROLL
#endif

#endif // CGAL_POWER_RTF_INTERNAL_HOST_DEVICE_H

# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What PowerRTF::PowerRTF stands on, for the build and for find_package(PowerRTF) alike:
# CGAL 5.5 or newer, Eigen, and TBB where it is found (CGAL::Parallel_tag).

# Sets POWER_RTF_DEPENDENCIES to the targets to link, or `missing` to what is not there.
macro(power_rtf_find_dependencies missing)
  set(${missing})
  # No version here: CGAL 6 refuses a request for 5.5.
  find_package(CGAL QUIET)
  find_package(Eigen3 CONFIG QUIET)
  find_package(TBB CONFIG QUIET)
  if(NOT CGAL_FOUND)
    set(${missing} "CGAL is not found. Install it (Debian, Ubuntu: libcgal-dev) or set CGAL_DIR.")
  elseif(CGAL_VERSION VERSION_LESS 5.5)
    set(${missing} "CGAL 5.5 or newer is needed, but ${CGAL_DIR} has ${CGAL_VERSION}.")
  elseif(NOT TARGET Eigen3::Eigen)
    set(${missing} "Eigen is not found. Install it (Debian, Ubuntu: libeigen3-dev) or set Eigen3_DIR.")
  else()
    set(EIGEN3_FOUND TRUE)
    include(CGAL_Eigen3_support)
    set(POWER_RTF_DEPENDENCIES CGAL::CGAL CGAL::Eigen3_support Eigen3::Eigen)
    if(TARGET TBB::tbb)
      include(CGAL_TBB_support)
      list(APPEND POWER_RTF_DEPENDENCIES CGAL::TBB_support)
    endif()
  endif()
endmacro()

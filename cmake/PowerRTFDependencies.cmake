# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What PowerRTF::PowerRTF stands on, for the build and for find_package(PowerRTF) alike:
# CGAL 5.5 or newer, and TBB where it is found (CGAL::Parallel_tag).

# Sets POWER_RTF_DEPENDENCIES to the targets to link, or `missing` to what is not there.
macro(power_rtf_find_dependencies missing)
  set(${missing})
  # No version here: CGAL 6 refuses a request for 5.5.
  find_package(CGAL QUIET)
  find_package(TBB CONFIG QUIET)
  if(NOT CGAL_FOUND)
    set(${missing} "CGAL is not found. Install it (Debian, Ubuntu: libcgal-dev) or set CGAL_DIR.")
  elseif(CGAL_VERSION VERSION_LESS 5.5)
    set(${missing} "CGAL 5.5 or newer is needed, but ${CGAL_DIR} has ${CGAL_VERSION}.")
  else()
    set(POWER_RTF_DEPENDENCIES CGAL::CGAL)
    if(TARGET TBB::tbb)
      include(CGAL_TBB_support)
      list(APPEND POWER_RTF_DEPENDENCIES CGAL::TBB_support)
    endif()
  endif()
endmacro()

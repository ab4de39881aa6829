// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/PowerRTF/option_table.h>

int main() { CGAL::PowerRTF::validate(CGAL::PowerRTF::Remeshing_options()); }

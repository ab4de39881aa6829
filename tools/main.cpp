// Copyright (c) 2026 The PowerRTF authors.
// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.h"

int main(int argc, char** argv) { return tools::run_program(argc, argv); }

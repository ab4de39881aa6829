# Copyright (c) 2026 The PowerRTF authors.
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the paper prints: Y. Yao et al., PowerRTF: Power Diagram based Restricted Tangent Face for
Surface Remeshing, Computer Graphics Forum 42(5), 2023. Its times are those of a GeForce RTX 2080 Ti
with an i7-9700K (MPS and RVC: on the CPU). Figures 9 to 11 and 13 are pictures and plots without
printed numbers. None: not legible in the copy that these numbers were read from."""

COLUMNS = ("q_min", "q_avg", "theta_min", "theta_min_avg", "below_30", "above_90", "distance_rms",
           "seconds")

# Table 1, n = 3000: model, density, method, then COLUMNS
TABLE_1 = [
    ("Armchair", "uniform", "MPS", .443, .798, 26.974, 44.421, .006, .166, .083, .472),
    ("Armchair", "uniform", "RVC", .616, .903, 33.151, 52.152, .000, .010, .105, 4.450),
    ("Armchair", "uniform", "RTF", .484, .883, 26.149, 50.185, .001, .015, .087, 6.882),
    ("Armchair", "uniform", "PowerRTF", .707, .929, 33.724, 53.805, .000, .000, .073, 1.565),
    ("Armchair", "curvature", "D-RVC", .529, .880, 21.242, 50.951, .001, .022, .135, 5.731),
    ("Armchair", "curvature", "PowerRTF", .476, .886, 25.730, 49.789, .001, .014, .066, 13.121),
    ("StandingCat", "uniform", "MPS", .477, .800, 27.350, 44.665, .004, .159, .107, .561),
    ("StandingCat", "uniform", "RVC", .599, .900, 34.935, 51.965, .000, .012, .094, 4.762),
    ("StandingCat", "uniform", "RTF", .530, .889, 27.618, 50.651, .001, .009, .066, 7.140),
    ("StandingCat", "uniform", "PowerRTF", .671, .917, 32.389, 52.726, .000, .000, .066, 2.754),
    ("StandingCat", "curvature", "D-RVC", .559, .907, 31.819, 52.513, .000, .007, .099, 6.541),
    ("StandingCat", "curvature", "PowerRTF", .600, .899, 31.007, 51.245, .000, .004, .068, 11.652),
    ("Kitten", "uniform", "MPS", .470, .799, 26.608, 44.379, .005, .166, .086, .387),
    ("Kitten", "uniform", "RVC", .646, .901, 35.509, 51.936, .000, .009, .067, 4.615),
    ("Kitten", "uniform", "RTF", .547, .887, 29.677, 50.490, .000, .009, .057, 7.591),
    ("Kitten", "uniform", "PowerRTF", .687, .925, 36.532, 53.468, .000, .000, .054, 1.658),
    ("Kitten", "curvature", "D-RVC", .597, .891, 30.217, 51.325, .000, .015, .124, 5.429),
    ("Kitten", "curvature", "PowerRTF", .581, .891, 29.494, 50.686, .000, .006, .052, 8.856),
]

# Table 2: figure, model, what, n, then COLUMNS without the seconds
TABLE_2 = [
    ("14", "Homer", "without weights", 3000, .489, .877, 22.088, 49.622, .001, .017, .051),
    ("14", "Homer", "with weights", 3000, .460, None, None, None, None, None, None),
    ("14", "Rocker", "without weights", 3000, .502, .871, 23.046, 49.031, .002, .014, .054),
    ("14", "Rocker", "with weights", 3000, .507, .884, 26.902, 50.013, .001, .012, .043),
    ("15", "Disc", "without NVISPC", 3000, .066, .710, 2.260, 38.072, .256, .316, .049),
    ("15", "Disc", "with NVISPC", 3000, .308, .836, 12.474, 46.605, .019, .079, .022),
    ("15", "Fish", "without NVISPC", 3000, .051, .792, None, 43.421, .096, .148, .083),
    ("15", "Fish", "with NVISPC", 3000, .394, .871, 14.939, 49.029, None, .020, None),
    ("16", "David Head", "uniform", 30000, .350, .875, 14.376, 49.605, .001, .021, .036),
    ("16", "David Head", "curvature", 10000, .472, .882, 20.497, 50.030, .002, .018, .075),
    ("16", "Gargoyle", "uniform", 30000, .275, .883, 13.172, 50.231, .001, .016, .043),
    ("16", "Gargoyle", "curvature", 10000, .408, .880, 19.571, 49.914, .001, .022, .039),
]

# Section 5.2 on Figures 10 and 11 (Fertility): the settings, and what it says of the plots
FIGURE_11_TOLERANCES = (0.02, 0.04, 0.06, 0.08, 0.10)
FIGURE_11_SAMPLES = (3000, 6000, 9000)
FIGURE_11_CLAIM = ("The paper plots these without printing numbers, and says: a small γ gives "
                   "better triangles (Q_min, θ_min) at the price of more iterations and time; so "
                   "does a larger n, with a few slender triangles.")


def table_1(model, density):
    """The rows of a model: (method, {column: value})."""
    return [(row[2], dict(zip(COLUMNS, row[3:]))) for row in TABLE_1
            if row[:2] == (model, density)]


def table_2(figure, model=None):
    """The rows of a figure: (model, what, n, {column: value})."""
    return [(row[1], row[2], row[3], dict(zip(COLUMNS, row[4:]))) for row in TABLE_2
            if row[0] == figure and model in (None, row[1])]

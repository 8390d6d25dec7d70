"""What the paper reports: the numbers of its Table 1, by Romeiro, Velho and de Figueiredo, Scalable
GPU rendering of CSG models, Computers & Graphics 32 (2008), section 4."""

# The models of Figures 12 and 13 and, of the columns of Table 1, those of the fastest machine: two
# quad-core Xeons of 2 GHz with a Quadro FX 5600 for T_R and S_R (milliseconds), an Athlon 64 3800+
# for T_pov (seconds). Table 1 has eight of the models; the others are in figures only.
MODELS = ["cheese250", "cheese500", "cheese1000", "cyl50", "cyl100", "cyl200", "cyl500", "cyl1000",
          "cone100", "cone200", "cone500", "cone1000", "tube300", "tube500", "tube1000", "widget", "r9"]
TABLE_1 = {
    "cheese250": {"T_R": 161, "S_R": 361, "T_pov": 33},
    "cheese500": {"T_R": 400, "S_R": 982, "T_pov": 134},
    "cheese1000": {"T_R": 1001, "S_R": 1627, "T_pov": 373},
    "cyl500": {"T_R": 234, "S_R": 1097, "T_pov": 136},
    "cone1000": {"T_R": 762, "S_R": 2472, "T_pov": 388},
    "r9": {"T_R": 17, "S_R": 31, "T_pov": 1},
    "widget": {"T_R": 17, "S_R": 17, "T_pov": 2},
    "tube1000": {"T_R": 84, "S_R": 265, "T_pov": 2},
}
# Figures 14 and 15: time against the number of cylinders and of cones.
SERIES = {"cylinders": ["cyl50", "cyl100", "cyl200", "cyl500"],
          "cones": ["cone100", "cone200", "cone500", "cone1000"]}

// The generators behind generate.h, one function a model; each appends to the text it is given.
#pragma once

#include "generate/csg_text.h"

namespace whittle {

// The models of the paper (Romeiro, Velho, de Figueiredo 2008, Figures 12 and 13).
void generate_cheese(CsgText& out, int spheres, Chance chance);
void generate_cyl(CsgText& out, int cylinders, Chance chance);
void generate_cone(CsgText& out, int cones, Chance chance);
void generate_tube(CsgText& out, int holes, Chance chance);
void generate_widget(CsgText& out, int unused, Chance chance);
void generate_r9(CsgText& out, int unused, Chance chance);

// Regular ones.
void generate_plate(CsgText& out, int holes_a_side, Chance chance);
void generate_menger(CsgText& out, int level, Chance chance);
void generate_lattice(CsgText& out, int cells_a_side, Chance chance);

void generate_random(CsgText& out, int primitives, Chance chance);

}  // namespace whittle

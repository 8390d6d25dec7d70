// A mounting bracket: modules, loops and all that a .csg no longer has.
thickness = 4;
$fn = 10;

module plate(size, holes) {
  difference() {
    translate([-size / 2, -size / 2, 0]) cube([size, size, thickness]);
    for (x = [-1, 1], y = [-1, 1])
      translate([x * size * holes, y * size * holes, -1]) cylinder(h = thickness + 2, r = size / 12);
  }
}

plate(40, 0.35);
translate([-20, -20, 0]) rotate([90, 0, 90]) mirror([0, 0, 1]) cube([40, 30, thickness]);
color("teal") translate([0, 0, thickness]) cylinder(h = 12, r1 = 9, r2 = 6);

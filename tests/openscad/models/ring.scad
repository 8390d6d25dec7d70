// Twelve balls on a ring, cut flush.
intersection() {
  for (i = [0 : 30 : 330]) rotate([0, 0, i]) translate([10, 0, 0]) sphere(3, $fn = 8);
  translate([-50, -50, -1.5]) cube([100, 100, 3]);
}

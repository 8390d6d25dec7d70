// Numbers as sums of two floats, the second of which is what the first has lost: some 46 bits.
// After T. J. Dekker, "A floating-point technique for extending the available precision",
// Numerische Mathematik 18 (1971), and D. E. Knuth, The Art of Computer Programming 2, 4.2.2.

#define Pair vec2

Pair pair_of(uvec2 words) { return Pair(to_real(words), rest_of(words)); }

// a + b, if |a| >= |b|.
Pair sum_of_sorted(Real a, Real b) {
  const Real sum = a + b;
  return Pair(sum, b - (sum - a));
}

Pair sum_of(Real a, Real b) {
  const Real sum = a + b, part = sum - a;
  return Pair(sum, (a - (sum - part)) + (b - part));
}

Pair product_of(Real a, Real b) {
  // Halves of twelve bits have exact products.
  const Real big_a = K(4097) * a, big_b = K(4097) * b;
  const Real high_a = big_a - (big_a - a), high_b = big_b - (big_b - b);
  const Real low_a = a - high_a, low_b = b - high_b, product = a * b;
  return Pair(product, ((high_a * high_b - product) + high_a * low_b + low_a * high_b) +
                           low_a * low_b);
}

Pair add(Pair a, Pair b) {
  const Pair sum = sum_of(a.x, b.x);
  return sum_of_sorted(sum.x, sum.y + (a.y + b.y));
}

Pair times(Pair a, Pair b) {
  const Pair product = product_of(a.x, b.x);
  return sum_of_sorted(product.x, product.y + (a.x * b.y + a.y * b.x));
}

// f of a half-space at a place relative to the view's reference.
Real value_by_pairs(uint half_space, Vec3 at) {
  const uint first = half_space * kHalfSpaceVectors;
  const uvec4 center0 = half_space_words(first), center1 = half_space_words(first + 1);
  const uvec4 a = half_space_words(first + 2), b = half_space_words(first + 3),
              c = half_space_words(first + 4), d = half_space_words(first + 5),
              e = half_space_words(first + 6);
  const uint kind = center1.z;
  const uvec2 none = uvec2(0), center[3] = {center0.xy, center0.zw, center1.xy};
  uvec2 diag[3] = {none, none, none}, off[3] = diag, linear[3] = diag, constant = none;
  if (kind == kPlane) {
    linear = uvec2[3](a.xy, a.zw, b.xy);
  } else if (is_sphere(kind)) {
    diag = uvec2[3](a.xy, a.xy, a.xy);
    constant = a.zw;
  } else {
    diag = uvec2[3](a.xy, a.zw, b.xy);
    off = uvec2[3](b.zw, c.xy, c.zw);
    linear = uvec2[3](d.xy, d.zw, e.xy);
    constant = e.zw;
  }
  Pair q[3];
  for (int i = 0; i < 3; ++i)
    q[i] = add(add(Pair(at[i], 0), pair_of(view_words(kViewReference + i))), K(-1) * pair_of(center[i]));
  Pair value = pair_of(constant);
  for (int i = 0; i < 3; ++i) {
    // Of A q + 2 b one number, off standing across from its axis.
    Pair sum = add(times(pair_of(diag[i]), q[i]), K(2) * pair_of(linear[i]));
    sum = add(sum, times(pair_of(off[3 - i - (i + 1) % 3]), q[(i + 1) % 3]));
    sum = add(sum, times(pair_of(off[3 - i - (i + 2) % 3]), q[(i + 2) % 3]));
    value = add(value, times(sum, q[i]));
  }
  return value.x;
}

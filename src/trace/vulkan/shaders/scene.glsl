// The scene's data as the device has it; src/trace/vulkan/flatten.h says what is where. Read from
// texel buffers or from storage buffers (WHITTLE_STORAGE): which is faster depends on the device.
#if WHITTLE_STORAGE
layout(set = 0, binding = kHalfSpacesBinding) readonly buffer HalfSpaces { uvec4 half_space_data[]; };
layout(set = 0, binding = kCellsBinding) readonly buffer Cells { uvec4 cell_data[]; };
layout(set = 0, binding = kWordsBinding) readonly buffer Words { uint word_data[]; };
uvec4 half_space_words(uint i) { return half_space_data[i]; }
uvec4 cell_words(uint i) { return cell_data[i]; }
uint word(uint i) { return word_data[i]; }
#else
layout(set = 0, binding = kHalfSpacesBinding) uniform usamplerBuffer half_space_data;
layout(set = 0, binding = kCellsBinding) uniform usamplerBuffer cell_data;
layout(set = 0, binding = kWordsBinding) uniform usamplerBuffer word_data;
uvec4 half_space_words(uint i) { return texelFetch(half_space_data, int(i)); }
uvec4 cell_words(uint i) { return texelFetch(cell_data, int(i)); }
uint word(uint i) { return texelFetch(word_data, int(i)).x; }
#endif

// Vectors of four words.
const uint kCellVectors = kCellWords / 4, kHalfSpaceVectors = kHalfSpaceWords / 4;

struct Box {
  Vec3 lo, hi;
};

Box cell_box(uint cell) {
  const uint first = cell * kCellVectors;
  const uvec4 a = cell_words(first), b = cell_words(first + 1), c = cell_words(first + 2);
  return Box(place(a.xy, a.zw, b.xy), place(b.zw, c.xy, c.zw));
}

struct Leaf {
  uint kind, count;
  uint first;  // of its literals, two words each: literal, owner
  uvec2 rule;  // kTable: the table; kProgram: x is the first step
};

Leaf cell_leaf(uint cell) {
  const uvec4 w = cell_words(cell * kCellVectors + 3);
  Leaf leaf = Leaf(w.y & ((1u << kLeafBits) - 1), w.y >> kLeafBits, w.x, w.zw);
  if (kFormulas >= kConjunctions) leaf.kind = kFormulas - kConjunctions + kConjunction;
  return leaf;
}

Vec3 half_space_center(uint i) {
  const uint first = i * kHalfSpaceVectors;
  const uvec4 a = half_space_words(first);
  return place(a.xy, a.zw, half_space_words(first + 1).xy);
}

// An AlongKind. A cone's centre is its tip, where its b and c are zero.
uint half_space_kind(uint i) { return half_space_words(i * kHalfSpaceVectors + 1).z; }
bool is_sphere(uint kind) { return kind == kSphere || kind == kSmallSphere; }

// Of a plane or quadric. A plane's second degree is zero and not stored.
Quadric half_space_quadric(uint i, uint kind) {
  const uint first = i * kHalfSpaceVectors + 2;
  const uvec4 a = half_space_words(first), b = half_space_words(first + 1);
  Quadric f;
  if (kind == kPlane) {
    f.diag = Vec3(0);
    f.off = Vec3(0);
    f.b = Vec3(to_real(a.xy), to_real(a.zw), to_real(b.xy));
    f.c = K(0);
  } else if (is_sphere(kind)) {
    f.diag = Vec3(to_real(a.xy));
    f.off = Vec3(0);
    f.b = Vec3(0);
    f.c = to_real(a.zw);
  } else {
    const uvec4 c = half_space_words(first + 2), d = half_space_words(first + 3),
                e = half_space_words(first + 4);
    f.diag = Vec3(to_real(a.xy), to_real(a.zw), to_real(b.xy));
    f.off = Vec3(to_real(b.zw), to_real(c.xy), to_real(c.zw));
    f.b = Vec3(to_real(d.xy), to_real(d.zw), to_real(e.xy));
    f.c = to_real(e.zw);
  }
  return f;
}

// What the backend and its shaders must agree on, written once for C++ (shader_constants.h) and GLSL
// (shaders/numbers.glsl).

// The case of leaves that a shader is made for (leaf_case.h): what it knows of the leaf's formula.
// One literal needs no case for its complement: the surface is seen from either side.
ENUM(FormulaCase)
  IS(kAnyFormula, 0)
  IS(kOneLiteral, 1)
  IS(kIntersection, 2)    // of A and B; along a ray a segment and a segment
  IS(kDifference, 3)      // A without B: a segment and two semi-intervals
  IS(kBackDifference, 4)  // B without A: two semi-intervals and a segment
  IS(kOutside, 5)         // outside of both: two semi-intervals and two semi-intervals
  IS(kConjunctions, 6)    // of more; from here on in the order of ShaderLeaf
  IS(kDisjunctions, 7)
  IS(kTables, 8)
  IS(kPrograms, 9)
END
// And of its surfaces. Spheres may be small.
ENUM(SurfaceCase)
  IS(kAnySurfaces, 0)
  IS(kPlanes, 1)
  IS(kPlanesAndSpheres, 2)
END
// Both are specialization constants with these numbers.
UINT(kFormulasConstant, 0)
UINT(kSurfacesConstant, 1)

// A cell's kind of leaf stands in the low bits of a word, the number of literals above them.
ENUM(ShaderLeaf)
  IS(kConjunction, 0)
  IS(kDisjunction, 1)
  IS(kTable, 2)
  IS(kProgram, 3)
END
UINT(kLeafBits, 2)

// A step of a leaf's formula: its kind in the low bits of a word, its operand above them.
ENUM(OwningStep)
  IS(kBeginAnd, 0)
  IS(kBeginOr, 1)
  IS(kEnd, 2)
  IS(kLiteral, 3)     // the operand is a literal of the leaf
  IS(kNotLiteral, 4)  // its complement
  IS(kElsewhere, 5)   // the operand is a half-space that does not cross the cell
  IS(kNotElsewhere, 6)
END
UINT(kStepBits, 3)

// Where a jump program ends.
UINT(kProgramTrue, 0xffffffffu)
UINT(kProgramFalse, 0xfffffffeu)

// Words of 32 bits, multiples of four. A number takes two (words.h).
UINT(kHalfSpaceWords, 28)
UINT(kCellWords, 16)
// Of a hit: distance, id, normal.
UINT(kHitWords, 5)

// Literals that a shader has room for in one cell.
UINT(kMostLiterals, 1024)
// Groups inside of groups that it can follow when it looks for the owner of a shared face: a bit each.
UINT(kMostNested, 32)

// The id where the host must look again.
UINT(kDoubtfulId, 0xffffffffu)

// Sides of a workgroup, and of a square in the pyramid of depths.
UINT(kGroupSide, 8)

// Where the view's numbers stand in View, which has room for so many.
UINT(kViewNumbers, 24)
UINT(kViewAxis, 0)     // three numbers, as all vectors
UINT(kViewRight, 3)
UINT(kViewUp, 6)
UINT(kViewForward, 9)
UINT(kViewScale, 12)
UINT(kViewHalfWidth, 13)
UINT(kViewHalfHeight, 14)
UINT(kViewStart, 15)
// In doubles:
UINT(kViewAtEye, 16)
UINT(kViewOnSurface, 17)
UINT(kViewAhead, 18)
UINT(kViewRayTolerance, 19)
// In floats:
UINT(kViewAxisAhead, 16)
UINT(kViewGrown, 17)
UINT(kViewBeyond, 18)
UINT(kViewAtSurface, 19)
UINT(kViewReference, 20)

// Bindings of the one descriptor set. Shaders that draw use those below kSeenBinding.
UINT(kViewBinding, 0)
UINT(kHalfSpacesBinding, 1)
UINT(kCellsBinding, 2)
UINT(kWordsBinding, 3)
UINT(kPositionsBinding, 4)
UINT(kSeenBinding, 5)
UINT(kHitsBinding, 6)
UINT(kDepthsBinding, 7)
UINT(kPyramidBinding, 8)
UINT(kInstancesBinding, 9)
UINT(kDrawsBinding, 10)
UINT(kLastSeenBinding, 11)
UINT(kPlacesBinding, 12)
UINT(kBindings, 13)

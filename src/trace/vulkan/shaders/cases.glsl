// The case of leaves that a shader is made for: what is constant here, the driver leaves out of the
// shader. Left alone, it takes all leaves.
layout(constant_id = kFormulasConstant) const uint kFormulas = kAnyFormula;
layout(constant_id = kSurfacesConstant) const uint kSurfaces = kAnySurfaces;

const bool kIsPair = kFormulas >= kIntersection && kFormulas <= kOutside;
// Of a pair: which of them is complemented.
const bool kFirstComplemented = kFormulas == kBackDifference || kFormulas == kOutside;
const bool kSecondComplemented = kFormulas == kDifference || kFormulas == kOutside;

// In what a pixel has seen, beside the cell's number and 1: who knows.
const uint kDoubtBit = 0x80000000u;

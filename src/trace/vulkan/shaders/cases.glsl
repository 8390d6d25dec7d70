// The case of leaves that a shader is made for, with the numbers of leaf_case.h: what is constant
// here, the driver leaves out of the shader. Left alone, it takes all leaves.
const uint kAnyFormula = 0, kOneLiteral = 1, kIntersection = 2, kDifference = 3,
           kBackDifference = 4, kOutside = 5, kConjunctions = 6, kDisjunctions = 7, kTables = 8,
           kPrograms = 9;
const uint kAnySurfaces = 0, kPlanes = 1, kPlanesAndSpheres = 2;

layout(constant_id = 0) const uint kFormulas = kAnyFormula;
layout(constant_id = 1) const uint kSurfaces = kAnySurfaces;

const bool kIsPair = kFormulas >= kIntersection && kFormulas <= kOutside;
// Of a pair: which of them is complemented.
const bool kFirstComplemented = kFormulas == kBackDifference || kFormulas == kOutside;
const bool kSecondComplemented = kFormulas == kDifference || kFormulas == kOutside;

// In what a pixel has seen, beside the cell's number and 1: who knows.
const uint kDoubtBit = 0x80000000u;

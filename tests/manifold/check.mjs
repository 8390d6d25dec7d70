// Meshes that whittle made, judged by Manifold: each must be a manifold to it, of as many handles as
// Euler's formula says, and enclose as much.
//
//     node check.mjs MANIFOLD-FOLDER MESH-FOLDER
//
// MESH-FOLDER is what manifold_meshes has written.
import {readFileSync} from 'node:fs';
import {join} from 'node:path';

import {load, manifoldOf, readOff} from './manifold.mjs';

const [packageFolder, folder] = process.argv.slice(2);
const {Manifold, Mesh} = await load(packageFolder);

// Whittle's own sums err by some 1e-16 of a box's volume, which a thin solid has little of.
const MOST = 1e-9;
// Fewer, and something is not written any more.
const LEAST_MESHES = 400;

/// What Manifold finds wrong with a mesh; nothing: ''.
function faultOf(off, volume, surface) {
  const manifold = manifoldOf(off, {Manifold, Mesh});
  if (typeof manifold === 'string') return manifold;
  const corners = off.points.length / 3, handles = 1 - (corners - off.faces.length / 6) / 2;
  const differs = (a, b) => !(Math.abs(a - b) <= MOST * Math.abs(b));
  let fault = '';
  if (manifold.numVert() !== corners)
    fault = `has ${manifold.numVert()} corners instead of ${corners}`;
  else if (manifold.genus() !== handles)
    fault = `has ${manifold.genus()} handles instead of ${handles}`;
  else if (differs(manifold.volume(), volume))
    fault = `has the volume ${manifold.volume()} instead of ${volume}`;
  else if (differs(manifold.surfaceArea(), surface))
    fault = `has the surface ${manifold.surfaceArea()} instead of ${surface}`;
  manifold.delete();
  return fault;
}

const meshes = readFileSync(join(folder, 'index.tsv'), 'utf8').trim().split('\n').map(line => {
  const [name, volume, surface] = line.split('\t');
  return {name, off: readOff(join(folder, name + '.off')), volume: +volume, surface: +surface};
});

// A judge who finds everything good is none.
const {off, volume, surface} = meshes[0];
const broken = [
  {...off, faces: off.faces.slice(3)},                                            // open
  {...off, faces: off.faces.map((corner, i) => i < 3 ? off.faces[2 - i] : corner)},  // turned round
];
const moved = {...off, points: off.points.map((x, i) => i === 0 ? x + 1 : x)};
for (const mesh of [...broken, moved])
  if (faultOf(mesh, volume, surface) === '') throw new Error('a broken mesh passes');

let faults = 0;
for (const {name, off, volume, surface} of meshes) {
  const fault = faultOf(off, volume, surface);
  if (fault === '') continue;
  console.log(`${name} ${fault}`);
  ++faults;
}
console.log(`${meshes.length} meshes, ${faults} of them with faults`);
process.exit(faults === 0 && meshes.length >= LEAST_MESHES ? 0 : 1);

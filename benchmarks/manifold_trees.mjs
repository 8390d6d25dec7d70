// Makes a solid in Manifold (WebAssembly, one thread) from a model of `whittle model`, and says how
// long that takes. benchmarks/solids runs it.
//
//     node manifold_trees.mjs MANIFOLD-FOLDER MODEL.csg SIDES REPEAT OFF-FILE
//
// Prints JSON: the milliseconds of the fastest run, triangles, volume, and the OFF file's volume.
import {readFileSync} from 'node:fs';

import {load, readOff} from '../tests/manifold/manifold.mjs';

const [packageFolder, model, sides, repeat, offFile] = process.argv.slice(2);
const {Manifold, Mesh} = await load(packageFolder);

/// OpenSCAD's sphere: rings without poles.
function sphere(r, n) {
  const rings = Math.floor((n + 1) / 2), points = [], faces = [];
  for (let i = 0; i < rings; ++i) {
    const phi = Math.PI * (i + 0.5) / rings;
    for (let k = 0; k < n; ++k) {
      const angle = 2 * Math.PI * k / n;
      points.push(r * Math.sin(phi) * Math.cos(angle), r * Math.sin(phi) * Math.sin(angle),
                  r * Math.cos(phi));
    }
  }
  const at = (ring, k) => ring * n + k % n;
  for (let k = 1; k + 1 < n; ++k) {
    faces.push(at(0, 0), at(0, k), at(0, k + 1));
    faces.push(at(rings - 1, 0), at(rings - 1, k + 1), at(rings - 1, k));
  }
  for (let i = 0; i + 1 < rings; ++i)
    for (let k = 0; k < n; ++k) {
      faces.push(at(i, k), at(i + 1, k), at(i + 1, k + 1));
      faces.push(at(i, k), at(i + 1, k + 1), at(i, k + 1));
    }
  return Manifold.ofMesh(new Mesh({
    numProp: 3, vertProperties: Float32Array.from(points), triVerts: Uint32Array.from(faces)}));
}

/// Numbers and vectors behind their names; a first one without a name is `_`.
function values(text) {
  const found = {};
  for (const [, name, value] of text.matchAll(/(?:(\w+) = )?(\[[^\]]*\]|true|false|[-\d.e]+)/g))
    found[name ?? '_'] = JSON.parse(value);
  return found;
}

const shapes = {
  cube: v => Manifold.cube(typeof v._ === 'number' ? [v._, v._, v._] : v._, v.center ?? false),
  sphere: v => sphere(v.r, +sides),
  cylinder: v => Manifold.cylinder(v.h, v.r ?? v.r1, v.r ?? v.r2, +sides, v.center ?? false),
};
const maps = {
  translate: (solid, v) => solid.translate(v._),
  rotate: (solid, v) => solid.rotate(v._),
};

/// A difference of shapes, each of which stands on a line of its own.
const lines = readFileSync(model, 'utf8').split('\n')
    .map(line => [...line.matchAll(/(translate|rotate|cube|sphere|cylinder)\(([^()]*)\)/g)])
    .filter(calls => calls.length > 0);

function make() {
  const operands = lines.map(calls => {
    const [, shape, how] = calls.at(-1);
    return calls.slice(0, -1).reduceRight((solid, [, map, by]) => maps[map](solid, values(by)),
                                          shapes[shape](values(how)));
  });
  return Manifold.difference(operands);
}

let best = Infinity, solid;
for (let i = 0; i < +repeat; ++i) {
  const start = performance.now();
  solid = make();
  solid.getMesh();
  best = Math.min(best, performance.now() - start);
}

const {points, faces} = readOff(offFile);
let six = 0;
for (let t = 0; t < faces.length; t += 3) {
  const [p, q, r] = [0, 1, 2].map(i => points.subarray(3 * faces[t + i], 3 * faces[t + i] + 3));
  six += p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
         p[2] * (q[0] * r[1] - q[1] * r[0]);
}
console.log(JSON.stringify({manifold_ms: best, manifold_triangles: solid.numTri(),
                            manifold_volume: solid.volume(), whittle_volume: six / 6}));

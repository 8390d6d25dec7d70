// Manifold's WebAssembly, and how a mesh comes into it with all digits.
import {readFileSync} from 'node:fs';
import {join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

export async function load(packageFolder) {
  const {default: start} = await import(pathToFileURL(resolve(packageFolder, 'manifold.js')));
  const wasm = await start();
  wasm.setup();
  return wasm;
}

/// An OFF file of triangles: {points: three numbers a corner, faces: three corners a triangle}.
export function readOff(path) {
  const numbers = readFileSync(path, 'utf8').slice('OFF'.length).trim().split(/\s+/).map(Number);
  const [corners, triangles] = numbers, first = 3 + 3 * corners;
  const faces = new Uint32Array(3 * triangles);
  for (let t = 0; t < triangles; ++t)
    for (let i = 0; i < 3; ++i) faces[3 * t + i] = numbers[first + 4 * t + 1 + i];
  return {points: Float64Array.from(numbers.slice(3, first)), faces};
}

/// The same places whenever it runs (a linear congruential generator).
function randomNumbers() {
  let state = 1;
  return () => (state = (state * 1103515245 + 12345) % 2147483648) / 2147483648;
}

/// Numbers from 0 to before n, neighbours far apart.
function shuffled(n) {
  const divisor = (a, b) => b === 0 ? a : divisor(b, a % b);
  let step = Math.ceil(0.618 * n);
  while (divisor(step, n) !== 1) ++step;
  return Array.from({length: n}, (_, i) => i * step % n);
}

/// A place for each corner, so that no triangle is a sliver; no two have the same x, `xs`.
function scattered(xs, faces) {
  const corners = xs.length, random = randomNumbers();
  const places = new Float32Array(3 * corners);
  const scatter = i => places.set([xs[i], random() * corners, random() * corners], 3 * i);
  for (let i = 0; i < corners; ++i) scatter(i);
  const isSliver = t => {
    const [a, b, c] = [0, 1, 2].map(i => places.subarray(3 * faces[t + i], 3 * faces[t + i] + 3));
    const u = [0, 1, 2].map(k => b[k] - a[k]), v = [0, 1, 2].map(k => c[k] - a[k]);
    const cross = Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                             u[0] * v[1] - u[1] * v[0]);
    const longest = Math.max(Math.hypot(...u), Math.hypot(...v));
    return cross < 1e-4 * corners * longest;
  };
  for (let again = true; again;) {
    again = false;
    for (let t = 0; t < faces.length; t += 3) {
      if (!isSliver(t)) continue;
      scatter(faces[t + Math.floor(random() * 3)]);
      again = true;
    }
  }
  return places;
}

/// The mesh as a Manifold, or in words why it is none.
///
/// Manifold computes in doubles, but its meshes come in as floats, and what is thin for those is
/// drawn together. So corners come in somewhere else, where nothing is thin, and are moved to where
/// they belong: that changes no triangle.
export function manifoldOf({points, faces}, {Manifold, Mesh}) {
  const xs = shuffled(points.length / 3), numbers = [];
  xs.forEach((x, i) => numbers[x] = i);
  const places = scattered(xs, faces);
  let scatteredSolid;
  try {
    scatteredSolid =
        Manifold.ofMesh(new Mesh({numProp: 3, vertProperties: places, triVerts: faces}));
  } catch (error) {
    return `is refused: ${error.message}`;
  }
  if (scatteredSolid.status() !== 'NoError') return `is refused: ${scatteredSolid.status()}`;
  const solid = scatteredSolid.warpBatch((corners, count) => {
    for (let i = 0; i < count; ++i) {
      const number = numbers[corners[3 * i]];
      corners.set(points.subarray(3 * number, 3 * number + 3), 3 * i);
    }
  });
  scatteredSolid.delete();
  return solid;
}

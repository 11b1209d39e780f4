// Loads packed files with three's GLTFLoader and compares what arrives with X.glb.expected.json, which a
// test wrote beside X.glb. One line per file; status 1 where anything differs.
import { readFileSync } from "node:fs";
import { FrontSide } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

// What three calls the attributes of glTF; custom ones are lower-cased.
const NAMES = { POSITION: "position", NORMAL: "normal", COLOR_0: "color", TANGENT: "tangent" };
let bad = 0;

for (const file of process.argv.slice(2)) {
  const problems = [];
  const expected = JSON.parse(readFileSync(`${file}.expected.json`, "utf8"));
  const bytes = readFileSync(file);
  const gltf = await new GLTFLoader().parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length), "");
  const meshes = new Map();
  gltf.scene.traverse((node) => node.isMesh && meshes.set(node.name, node));
  let compared = 0;
  for (const [name, attributes] of Object.entries(expected.meshes)) {
    const mesh = meshes.get(name);
    if (!mesh) {
      problems.push(`no mesh ${name}, there are ${[...meshes.keys()]}`);
      continue;
    }
    for (const [attribute, want] of Object.entries(attributes)) {
      const key = NAMES[attribute] ?? attribute.toLowerCase();
      const found = mesh.geometry.getAttribute(key);
      const problem = found ? differs(found, want) : "is missing";
      if (problem) problems.push(`${name}: ${attribute} (${key}) ${problem}`);
      compared += found?.count ?? 0;
    }
    const colored = "COLOR_0" in attributes;
    if (mesh.material.vertexColors !== colored) problems.push(`${name}: vertexColors is ${!colored}: COLOR_0 is not applied`);
    const sheets = expected.sheets?.[name];
    if (sheets !== undefined) problems.push(...backs(name, mesh, sheets));
  }
  bad += problems.length;
  const said = problems.length ? problems.join("; ") : `${Object.keys(expected.meshes).length} meshes as expected, ${compared} values per vertex compared`;
  console.log(`three: ${file.split("/").pop()}: ${said}`);
}
process.exit(bad ? 1 : 0);

// The first value that is off by more than the tolerance.
function differs(found, want) {
  if (found.itemSize !== want.width) return `has ${found.itemSize} numbers per vertex, not ${want.width}`;
  if (found.count * want.width !== want.values.length) return `has ${found.count} vertices, not ${want.values.length / want.width}`;
  for (let v = 0; v < found.count; v++) {
    for (let c = 0; c < want.width; c++) {
      const value = found.getComponent(v, c);
      const wanted = want.values[v * want.width + c];
      if (!(Math.abs(value - wanted) <= want.tolerance)) return `of vertex ${v} is ${value}, not ${wanted}`;
    }
  }
}

// What was seen from both sides must be two sheets: three turns over the normals of a DoubleSide material's backs.
function backs(name, mesh, triangles) {
  const { index } = mesh.geometry;
  const wound = new Set();
  for (let t = 0; t < index.count; t += 3) {
    const [a, b, c] = [0, 1, 2].map((i) => index.getX(t + i));
    for (const corners of [[a, b, c], [b, c, a], [c, a, b]]) wound.add(corners.join());
  }
  let missing = 0;
  for (let t = 0; t < index.count; t += 3) {
    if (!wound.has([index.getX(t), index.getX(t + 2), index.getX(t + 1)].join())) missing++;
  }
  const found = index.count / 3;
  const problems = found === 2 * triangles ? [] : [`${name}: ${found} triangles, not twice ${triangles}`];
  if (missing) problems.push(`${name}: ${missing} triangles have no back`);
  if (mesh.material.side !== FrontSide) problems.push(`${name}: its material is drawn from both sides`);
  return problems;
}

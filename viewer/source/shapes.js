// Solids of the scene as three.js geometry, in metres.
import {
  BoxGeometry, BufferGeometry, CylinderGeometry, EdgesGeometry, ExtrudeGeometry, Float32BufferAttribute,
  Matrix4, Shape, SphereGeometry,
} from 'three';

/// A geometry of points, three numbers each.
export function geometryOf(points) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(points, 3));
  return geometry;
}

/// The axis in the pad plane about which the object can roll; none where it cannot.
export function rollAxis({prisms, cylinders}) {
  return [...prisms, ...cylinders].find(({axis}) => axis !== 'z')?.axis;
}

function shapeOf(outline) {
  const shape = new Shape();
  outline.forEach(([x, y], i) => (i === 0 ? shape.moveTo(x, y) : shape.lineTo(x, y)));
  shape.closePath();
  return shape;
}

/// Extruded from z = low to z = high.
export function prism(outline, low, high) {
  const geometry = new ExtrudeGeometry(shapeOf(outline), {
    depth: high - low,
    bevelEnabled: false,
  });
  return geometry.translate(0, 0, low);
}

/// A frame whose columns are where x, y and z of the drawing point.
function turned(geometry, x, y, z) {
  const frame = new Matrix4().set(
    x[0], y[0], z[0], 0,
    x[1], y[1], z[1], 0,
    x[2], y[2], z[2], 0,
    0, 0, 0, 1,
  );
  return geometry.applyMatrix4(frame);
}

/// A section drawn with the lateral axis to the right and z upwards, along its axis.
function lyingPrism({outline, low, high, axis}) {
  if (axis === 'x') return turned(prism(outline, low, high), [0, 1, 0], [0, 0, 1], [1, 0, 0]);
  return turned(prism(outline, -high, -low), [1, 0, 0], [0, 0, 1], [0, -1, 0]);
}

function cylinder({radius, length, axis}) {
  const geometry = new CylinderGeometry(radius, radius, length, 64);  // along y
  geometry.userData.edges = cylinderEdges(radius, length);
  for (const turn of [geometry, geometry.userData.edges]) turnTo(turn, axis);
  return geometry;
}

function turnTo(geometry, axis) {
  if (axis === 'x') geometry.rotateZ(-0.5 * Math.PI);
  if (axis === 'z') geometry.rotateX(0.5 * Math.PI);
}

/// Its rims, and four lines that show how it turns, one of them on to the middle.
function cylinderEdges(radius, length) {
  const half = 0.5 * length;
  const points = [];
  const steps = 64;
  for (let i = 0; i < steps; ++i) {
    const [a, b] = [i, i + 1].map((k) => (2 * Math.PI * k) / steps);
    for (const y of [-half, half]) {
      points.push(radius * Math.cos(a), y, radius * Math.sin(a), radius * Math.cos(b), y, radius * Math.sin(b));
    }
  }
  for (let i = 0; i < 4; ++i) {
    const [x, z] = [radius * Math.cos(0.5 * Math.PI * i), radius * Math.sin(0.5 * Math.PI * i)];
    points.push(x, -half, z, x, half, z);
  }
  for (const y of [-half, half]) points.push(0, y, 0, radius, y, 0);
  return geometryOf(points);
}

/// The lines that make a shape readable.
export function edgesOf(geometry) {
  return geometry.userData.edges?.clone() ?? new EdgesGeometry(geometry, 25);
}

/// The side of a body from a mesh: a strip per edge of its silhouette.
function sideStrips(sides) {
  const positions = [];
  for (const {a, b, low, high} of sides) {
    const [p, q, r, s] = [[...a, low], [...b, low], [...b, high], [...a, high]];
    positions.push(...p, ...r, ...q, ...p, ...s, ...r);
  }
  const geometry = geometryOf(positions);
  geometry.computeVertexNormals();
  return geometry;
}

/// Triangles of the data: flat, so that edges stay sharp.
export function triangles({vertices, triangles: indices}) {
  const geometry = geometryOf(vertices.map((um) => 1e-6 * um));
  geometry.setIndex(indices);
  const flat = geometry.toNonIndexed();
  flat.computeVertexNormals();
  return flat;
}

/// What is drawn of the object: its mesh where there is one.
export function objectGeometries(object) {
  return object.mesh ? [triangles(object.mesh)] : plainGeometries(object);
}

/// What the mechanics keeps of the object.
export function plainGeometries(object) {
  const solids = object.prisms.map((body) =>
    body.axis === 'z' ? prism(body.outline, body.low, body.high) : lyingPrism(body));
  solids.push(...object.cylinders.map(cylinder));
  if (object.sides.length > 0) solids.push(sideStrips(object.sides));
  return solids;
}

/// A feature in the frame (n, t, z) of its centre: x along the normal, into the object.
export function pusherGeometry(pusher, reach) {
  const thin = 0.02 * reach;
  if (pusher.feature === 'point') return new SphereGeometry(1.5 * thin, 24, 16).translate(-1.5 * thin, 0, 0);
  const along = pusher.length || 3 * thin;
  const across = pusher.width || 3 * thin;
  const depth = pusher.feature === 'plane' ? 4 * thin : 3 * thin;
  return new BoxGeometry(depth, along, across).translate(-0.5 * depth, 0, 0);
}


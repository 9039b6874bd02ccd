// A solid as it is drawn: its surface and its edges.
import {DoubleSide, Group, LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial} from 'three';

import {edgesOf} from './shapes.js';

export function solid(geometry, colour, opacity, ink) {
  const group = new Group();
  const material = new MeshLambertMaterial({
    color: colour, transparent: opacity < 1, opacity, depthWrite: opacity > 0.5, side: DoubleSide,
  });
  group.add(new Mesh(geometry, material));
  group.add(new LineSegments(edgesOf(geometry), new LineBasicMaterial({color: ink})));
  return group;
}

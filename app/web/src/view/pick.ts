// Ray casting: the nearest entry of a layer under a point of the view.
import * as THREE from 'three';
import { Pose } from './painter';
import type { Pixel, Stage } from './stage';
import { type Frame, NO_BODY } from '../source/link';

export interface Hit {
  body: number;
  point: THREE.Vector3; // world
  distance: number; // from the eye [m]
}

const ray = new THREE.Raycaster();
const probe = new THREE.Mesh<THREE.BufferGeometry, THREE.MeshBasicMaterial>(
  undefined,
  new THREE.MeshBasicMaterial({ side: THREE.DoubleSide }),
);
const pose = new Pose();

// The ray through a point of the view.
export function rayAt(stage: Stage, { x, y }: Pixel): THREE.Ray {
  const { clientWidth, clientHeight } = stage.host;
  const at = new THREE.Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight);
  ray.setFromCamera(at, stage.camera);
  return ray.ray.clone();
}

// Cost: a bounding-sphere test per entry, triangle tests for those hit.
export function pick(stage: Stage, frame: Frame, layer: number, at: Pixel): Hit | null {
  if (layer >= frame.layers) return null;
  rayAt(stage, at);
  let nearest: Hit | null = null;
  for (let i = frame.first[layer]; i < frame.first[layer + 1]; ++i) {
    const geometry = stage.painter.geometries[frame.mesh[i]];
    if (frame.body[i] === NO_BODY || !geometry) continue;
    probe.geometry = geometry;
    pose.read(frame, i).compose(probe.matrixWorld);
    for (const { point, distance } of ray.intersectObject(probe, false))
      if (!nearest || distance < nearest.distance) nearest = { body: frame.body[i], point, distance };
  }
  return nearest;
}

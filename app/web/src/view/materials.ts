// How surfaces are drawn, and what is drawn before what.
import * as THREE from 'three';

export const ORDER = { solid: 0, outline: 1, hidden: 5, ghostDepth: 6, ghost: 7 };

// Plain: without gloss, a third of the work for a processor that draws by itself.
export type Surface = THREE.MeshStandardMaterial | THREE.MeshLambertMaterial;
export type SurfaceOf = (shininess: number) => Surface;
export const glossy: SurfaceOf = (shininess) =>
  new THREE.MeshStandardMaterial({ roughness: 0.85 - 0.5 * shininess, metalness: 0.05 });
export const plainly: SurfaceOf = () => new THREE.MeshLambertMaterial();

export function solidMaterial(material: Surface, map: THREE.Texture | null, twoSided: boolean) {
  material.map = map;
  if (twoSided) material.side = THREE.DoubleSide;
  return material;
}

// Depth first, then colour where nearest: a shell shows one surface and not its inside. Both are
// pushed back a little: a ghost in the place of a body vanishes instead of flickering.
export function ghostMaterials(color: Surface, alpha: number) {
  const pushed = { polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 4 };
  const depth = new THREE.MeshBasicMaterial({ colorWrite: false, transparent: true, ...pushed });
  color.setValues({ transparent: true, opacity: alpha, depthWrite: false, ...pushed });
  return [
    { material: depth, order: ORDER.ghostDepth, shadow: false },
    { material: color, order: ORDER.ghost, shadow: false },
  ];
}

// What lies behind bodies, laid over them.
export function hiddenMaterials(color: Surface, alpha: number) {
  color.setValues({
    transparent: true,
    opacity: 0.45 * alpha,
    depthFunc: THREE.GreaterDepth,
    depthWrite: false,
  });
  return [{ material: color, order: ORDER.hidden, shadow: false }];
}

// The back of a hull that is wider by a few pixels at any distance: of it only the rim is seen.
const WIDER = `
vec3 lengths = vec3(dot(instanceMatrix[0], instanceMatrix[0]),
  dot(instanceMatrix[1], instanceMatrix[1]), dot(instanceMatrix[2], instanceMatrix[2]));
vec3 outward = normalize(mat3(modelViewMatrix) * (mat3(instanceMatrix) * (normal / lengths)));
vec4 mvPosition = modelViewMatrix * instanceMatrix * vec4(transformed, 1.0);
mvPosition.xyz += 0.0035 * -mvPosition.z * outward;
gl_Position = projectionMatrix * mvPosition;`;

export function outlineMaterials() {
  const material = new THREE.MeshBasicMaterial({ side: THREE.BackSide });
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader.replace('#include <project_vertex>', WIDER);
  };
  return [{ material, order: ORDER.outline, shadow: false }];
}

// Planar poses [x, y, theta], named as in the C++ code: X_AB is the pose of B in A.

export function compose(X_AB, X_BC) {
  const [x, y] = transform(X_AB, X_BC);
  return [x, y, X_AB[2] + X_BC[2]];
}

export function inverse(X_AB) {
  const c = Math.cos(X_AB[2]);
  const s = Math.sin(X_AB[2]);
  return [-(c * X_AB[0] + s * X_AB[1]), s * X_AB[0] - c * X_AB[1], -X_AB[2]];
}

export function transform(X_AB, p_B) {
  const c = Math.cos(X_AB[2]);
  const s = Math.sin(X_AB[2]);
  return [X_AB[0] + c * p_B[0] - s * p_B[1], X_AB[1] + s * p_B[0] + c * p_B[1]];
}

export const lerp = (a, b, share) => a + share * (b - a);

export const lerpAll = (a, b, share) => a.map((value, i) => lerp(value, b[i], share));

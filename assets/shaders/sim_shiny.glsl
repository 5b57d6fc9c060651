// A glaze mirrors the key light, as wide as that is, and more of the room the flatter one looks.
uniform vec3 eye_in_world;
uniform vec3 highlight_from;  // unit, towards the key light
uniform float shine;

vec3 with_highlight(vec3 color, vec3 light) {
  vec3 n = normalize(normal_in_world);
  vec3 v = normalize(eye_in_world - point_in_world);
  float facing = max(dot(n, normalize(v + highlight_from)), 0.0);
  float flat_look = 1.0 - max(dot(n, v), 0.0);
  float mirrored = 0.9 * pow(facing, 90.0) + 0.25 * flat_look * flat_look * flat_look * flat_look;
  return sqrt(color * color + shine * mirrored * light * light);
}

// Where a glaze mirrors the depth camera's own projector, the glare drowns the pattern.
float sent_back(float infrared) {
  vec3 n = normalize(normal_in_world);
  vec3 v = normalize(eye_in_world - point_in_world);
  float glare = shine * pow(max(dot(n, v), 0.0), 200.0);
  return glare > 0.15 ? 0.0 : infrared;
}

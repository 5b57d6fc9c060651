in float distance_z;
in vec3 shade;
in vec3 normal_in_camera;
in vec3 towards_half;
out vec4 color;

void main() {
  float facing = dot(normalize(normal_in_camera), towards_half);
  // (1 - 22 (1 - f))^3 follows f^90 where either is bright, without a power.
  float highlight = max(1.0 - 22.0 * (1.0 - facing), 0.0);
  vec3 linear = shade + 0.45 * highlight * highlight * highlight * vec3(1.0, 0.96, 0.9);
  linear = min(linear, 0.8 + 0.2 * linear / (0.2 + linear));  // a shoulder instead of clipped highlights
  float seen = visibility(gl_FragCoord.xy - 0.5, distance_z);
  color = vec4(sqrt(linear) * seen, seen);  // sqrt is within 0.03 of sRGB's curve
}

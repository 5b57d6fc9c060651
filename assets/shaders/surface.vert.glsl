// Mapped surface elements as points, as large as they appear.
layout(location = 0) in vec3 point_in_world;
layout(location = 1) in vec3 normal;  // towards the free side
layout(location = 2) in float intensity;
uniform float element_size;    // m
uniform vec3 light_in_camera;  // towards it, unit
out vec3 shade;

void main() {
  vec3 p = camera_from_world(point_in_world);
  gl_Position = clip_from_camera(p);
  float px_per_metre = view_target_from_pixel.x * view_focal_centre.x;
  if (view_model != 4) px_per_metre /= max(p.z, view_near_far.x);
  // A little over the element, so that slanted neighbours close up.
  gl_PointSize = clamp(1.6 * element_size * px_per_metre, 2.0, 24.0);
  // Warm light from one side, cool from everywhere, on what the camera saw.
  float towards = dot(normalize(mat3(view_camera_from_world) * normal), light_in_camera);
  vec3 light = mix(vec3(0.50, 0.55, 0.64), vec3(1.06, 1.03, 0.98), 0.5 + 0.5 * towards);
  shade = light * mix(0.10, 1.0, pow(intensity, 0.8));
}

// One straight segment an instance, widened on the target. The ends go through the lens; what is
// behind the near plane is cut off.
layout(location = 0) in vec3 from_in_world;
layout(location = 1) in vec4 from_color;
layout(location = 2) in vec3 to_in_world;
layout(location = 3) in vec4 to_color;
uniform float width;  // px
out vec4 color_;
out float across;     // px from the middle

void main() {
  vec3 a = camera_from_world(from_in_world);
  vec3 b = camera_from_world(to_in_world);
  float near = 1.01 * view_near_far.x;
  bool hidden = view_model != 4 && max(a.z, b.z) < near;
  if (view_model != 4 && !hidden) {
    vec3 from = a;
    if (a.z < near) a = mix(a, b, (near - a.z) / (b.z - a.z));
    if (b.z < near) b = mix(b, from, (near - b.z) / (from.z - b.z));
  }
  vec4 clip_a = clip_from_camera(a);
  vec4 clip_b = clip_from_camera(b);
  vec2 along = (clip_b.xy / clip_b.w - clip_a.xy / clip_a.w) * target_size;
  float length_px = 0.5 * length(along);
  along = length_px > 1e-3 ? normalize(along) : vec2(1.0, 0.0);
  bool end = gl_VertexID >= 2;
  float side = (gl_VertexID & 1) == 1 ? 1.0 : -1.0;
  across = side * (0.5 * width + 1.0);
  vec2 shift = vec2(-along.y, along.x) * across + along * (end ? 0.4 : -0.4);
  vec4 clip = end ? clip_b : clip_a;
  clip.xy += 2.0 * shift / target_size * clip.w;
  gl_Position = hidden ? vec4(2.0, 2.0, 2.0, 1.0) : clip;
  color_ = end ? to_color : from_color;
  // What passes close by the viewer would cross the whole picture.
  if (view_model != 4) color_.a *= smoothstep(0.12, 0.45, clip.w);
}

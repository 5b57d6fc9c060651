// Hiding by what the real scene has in front. The scene's depth lies in the view's own pixels.
uniform sampler2D scene_depth;        // m along z, NaN unknown
uniform vec4 scene_depth_from_target; // scale xy, offset xy, in texels with (0,0) a centre
uniform int has_scene_depth;

// 1 seen, 0 hidden, between the two over 1.5 cm. The tolerance grows as the error of depth cameras
// does, with the square of the distance (1.425e-3 per metre is a Kinect's sigma; twice that).
float seen_at(float scene_z, float z) {
  if (isnan(scene_z) || scene_z <= 0.0) return 1.0;
  float tolerance = 0.005 + 0.003 * z * z;
  return smoothstep(-tolerance - 0.015, -tolerance, scene_z - z);
}

// The comparison is interpolated, not the depth: depth averaged over an edge lies in mid-air, and
// one unknown neighbour would make it unknown.
float visibility(vec2 target_pixel, float z) {
  if (has_scene_depth == 0) return 1.0;
  vec2 texel = scene_depth_from_target.zw + scene_depth_from_target.xy * target_pixel;
  ivec2 last = textureSize(scene_depth, 0) - 1;
  ivec2 first = ivec2(floor(texel));
  vec2 f = texel - vec2(first);
  ivec2 a = clamp(first, ivec2(0), last);
  ivec2 b = clamp(first + 1, ivec2(0), last);
  float upper = mix(seen_at(texelFetch(scene_depth, a, 0).r, z),
                    seen_at(texelFetch(scene_depth, ivec2(b.x, a.y), 0).r, z), f.x);
  float lower = mix(seen_at(texelFetch(scene_depth, ivec2(a.x, b.y), 0).r, z),
                    seen_at(texelFetch(scene_depth, b, 0).r, z), f.x);
  return mix(upper, lower, f.y);
}

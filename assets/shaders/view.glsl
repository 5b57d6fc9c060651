// A view's camera, after target.glsl. Camera frame: x right, y down, z forward; pixel (0,0) is a pixel's centre.
uniform int view_model;              // 0 pinhole, 1 polynomial, 2 fisheye, 3 monoslam, 4 orthographic
uniform vec4 view_focal_centre;      // fx fy cx cy [px], px per metre when orthographic
uniform float view_coefficients[8];  // in OpenCV's order
uniform float view_max_radius;       // undistorted radius up to which the model is one-to-one
uniform vec4 view_target_from_pixel; // scale xy, offset xy
uniform vec2 view_near_far;          // m
uniform mat4 view_camera_from_world;

vec4 clip_from_pixel(vec2 pixel, float z, float w) {
  float n = view_near_far.x;
  float f = view_near_far.y;
  float depth = view_model == 4 ? (2.0 * z - n - f) / (f - n) : (f + n - 2.0 * f * n / w) / (f - n);
  return clip_from_target(view_target_from_pixel.zw + view_target_from_pixel.xy * pixel, depth, w);
}

// Normalised coordinates after the lens.
vec2 distort(vec2 p) {
  float r2 = dot(p, p);
  if (view_model == 1) {
    float radial = (1.0 + r2 * (view_coefficients[0] + r2 * (view_coefficients[1] + r2 * view_coefficients[4]))) /
                   (1.0 + r2 * (view_coefficients[5] + r2 * (view_coefficients[6] + r2 * view_coefficients[7])));
    float p1 = view_coefficients[2];
    float p2 = view_coefficients[3];
    return p * radial + vec2(2.0 * p1 * p.x * p.y + p2 * (r2 + 2.0 * p.x * p.x),
                             p1 * (r2 + 2.0 * p.y * p.y) + 2.0 * p2 * p.x * p.y);
  }
  if (view_model == 2) {
    float r = sqrt(r2);
    if (r < 1e-6) return p;
    float theta = atan(r);
    float t2 = theta * theta;
    float angle = theta * (1.0 + t2 * (view_coefficients[0] + t2 * (view_coefficients[1] +
                           t2 * (view_coefficients[2] + t2 * view_coefficients[3]))));
    return p * (angle / r);
  }
  if (view_model == 3) {
    vec2 px = p * view_focal_centre.xy;
    return p * inversesqrt(max(1.0 + 2.0 * view_coefficients[0] * dot(px, px), 1e-6));
  }
  return p;
}

vec4 clip_from_camera(vec3 point_in_camera) {
  vec3 p = point_in_camera;
  vec2 f = view_focal_centre.xy;
  vec2 c = view_focal_centre.zw;
  if (view_model == 4) return clip_from_pixel(f * p.xy + c, p.z, 1.0);
  // In front of the near plane the lens has no meaning, but triangles that cross it are clipped by
  // these vertices: they stay where the undistorted camera puts them.
  float w = p.z;
  if (view_model == 0 || w < view_near_far.x) {
    if (abs(w) < 1e-6) w = 1e-6;
    return clip_from_pixel(f * p.xy / w + c, w, w);
  }
  vec2 xy = p.xy / w;
  // Beyond the radius where the model folds back, go on outwards at its last magnification.
  float inside = min(1.0, view_max_radius / max(length(xy), 1e-9));
  return clip_from_pixel(f * distort(xy * inside) / inside + c, w, w);
}

vec3 camera_from_world(vec3 point_in_world) {
  return (view_camera_from_world * vec4(point_in_world, 1.0)).xyz;
}

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
uniform mat4 camera_from_object;  // a similarity
uniform float grow;               // px outwards, for outlines
out vec3 point_in_camera;
out vec3 normal_in_camera;
out vec3 albedo;

void main() {
  normal_in_camera = normalize(mat3(camera_from_object) * normal);
  point_in_camera = (camera_from_object * vec4(position, 1.0)).xyz;
  if (grow > 0.0) {
    float px_per_metre = view_target_from_pixel.x * view_focal_centre.x;
    if (view_model != 4) px_per_metre /= max(point_in_camera.z, view_near_far.x);
    point_in_camera += normal_in_camera * (grow / px_per_metre);
  }
  albedo = color.rgb * color.rgb;  // near enough to linear
  gl_Position = clip_from_camera(point_in_camera);
}

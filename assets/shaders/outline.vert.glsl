// The hull of a mesh, grown by some pixels.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
uniform mat4 camera_from_object;
uniform float grow;    // px outwards
out float distance_z;  // m along z

void main() {
  vec3 point = (camera_from_object * vec4(position, 1.0)).xyz;
  float px_per_metre = view_target_from_pixel.x * view_focal_centre.x;
  if (view_model != 4) px_per_metre /= max(point.z, view_near_far.x);
  point += normalize(mat3(camera_from_object) * normal) * (grow / px_per_metre);
  distance_z = point.z;
  gl_Position = clip_from_camera(point);
}

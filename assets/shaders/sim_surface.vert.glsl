// Things of a simulated world; joined after target.glsl and view.glsl.
layout(location = 0) in vec3 position;  // in the thing's frame
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 texture_place;
layout(location = 3) in vec2 light_place;
uniform mat4 world_from_thing;
out vec3 point_in_world;
out vec3 normal_in_world;
out vec2 texture_at;
out vec2 light_at;
out float depth;  // m along the camera's z

void main() {
  vec4 placed = world_from_thing * vec4(position, 1.0);
  vec3 seen = camera_from_world(placed.xyz);
  point_in_world = placed.xyz;
  normal_in_world = mat3(world_from_thing) * normal;
  texture_at = texture_place;
  light_at = light_place;
  depth = seen.z;
  gl_Position = clip_from_camera(seen);
}

// Light from one far direction onto each texel of the light map; joined after view.glsl, whose view
// looks along that direction, with the nearest depths that it sees.
uniform sampler2D positions;  // xyz in the world, w = 0 where no surface is
uniform sampler2D normals;
uniform sampler2D nearest;
uniform vec3 towards_light;
uniform vec3 radiance;  // on a surface that faces the light
uniform float offset;   // m, off the surface, so that it does not shade itself
out vec4 light_out;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
  vec4 place = texelFetch(positions, texel, 0);
  vec3 normal = texelFetch(normals, texel, 0).xyz;
  float facing = place.w * max(dot(normal, towards_light), 0.0);
  vec3 seen = camera_from_world(place.xyz + offset * normal);
  vec2 pixel = view_focal_centre.xy * seen.xy + view_focal_centre.zw;
  float blocker = texture(nearest, (pixel + 0.5) / view_target_size).r;
  light_out = vec4(seen.z < blocker + 0.5 * offset ? facing * radiance : vec3(0.0), 1.0);
}

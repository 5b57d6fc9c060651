// The plane that a pixel saw; a header of its own because the inner loop includes nothing else.
#pragma once

namespace armsreach::mapping {

// Points p of the plane: x p_x + y p_y + z p_z = distance, the normal a unit vector pointing away
// from the camera. All zero where the depth is unknown. A negative distance marks a pixel that is
// not trusted to add surface: its plane is at -distance, and only the free space in front counts.
struct PixelPlane {
  float x = 0;
  float y = 0;
  float z = 0;
  float distance = 0;
};

}  // namespace armsreach::mapping

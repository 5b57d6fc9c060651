// A TUM recording with some of its frames covered, left out or blinded; its images are linked, not
// copied.
#pragma once

#include <filesystem>
#include <functional>

namespace armsreach::test {

enum class FrameEdit {
  keep,
  cover,        // a black picture, no depth: a hand over the camera
  blind_depth,  // the picture alone
  leave_out,    // not there; the frames after it keep their times
};

// Writes into `folder`, which need not exist. `edit` is asked of every frame in turn.
void edit_recording(const std::filesystem::path& recording, const std::filesystem::path& folder,
                    const std::function<FrameEdit(int)>& edit);

}  // namespace armsreach::test

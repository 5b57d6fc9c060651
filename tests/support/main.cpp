// The entry of every test program: OpenCV works with one thread, as in the program itself.
#include <gtest/gtest.h>
#include <opencv2/core/utility.hpp>

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

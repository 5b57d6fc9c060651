armsreach_bench_part(
  SOURCES relocalisation_bench.cpp
          ${PROJECT_SOURCE_DIR}/tests/unit/vision/relocalisation/painted_room.cpp
  LINKS armsreach_relocalisation opencv_core opencv_imgproc opencv_features2d)

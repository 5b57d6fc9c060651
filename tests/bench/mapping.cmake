armsreach_bench_part(SOURCES mapping_bench.cpp
                     LINKS armsreach_mapping opencv_imgcodecs octomap octomath)

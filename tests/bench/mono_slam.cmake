armsreach_bench_part(SOURCES mono_slam_bench.cpp textbook_ekf.cpp
                     LINKS armsreach_mono_slam opencv_imgproc)

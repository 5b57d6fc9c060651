armsreach_bench_part(SOURCES ${CMAKE_CURRENT_LIST_DIR}/render_bench.cpp LINKS armsreach_tiny_world)

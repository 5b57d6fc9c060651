armsreach_bench_part(SOURCES hand_bench.cpp LINKS armsreach_hand)

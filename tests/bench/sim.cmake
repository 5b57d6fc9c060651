armsreach_bench_part(SOURCES sim_bench.cpp LINKS armsreach_sim)

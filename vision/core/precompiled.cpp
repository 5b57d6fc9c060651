// Nothing of its own: carries the precompiled headers (CMakeLists.txt).

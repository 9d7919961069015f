// Nothing: CMakeLists.txt precompiles the headers of skerry_test_headers.

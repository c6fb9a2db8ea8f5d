# Every test of a GoogleTest program as a test of CTest. Suites named *TimingTest hold times against each other: each of
# their tests runs alone.
function(lightwell_discover_tests program prefix)
  gtest_discover_tests(${program} TEST_PREFIX ${prefix} DISCOVERY_MODE PRE_TEST TEST_LIST ${program}_list
                       TEST_FILTER "-*TimingTest.*")
  gtest_discover_tests(${program} TEST_PREFIX ${prefix} DISCOVERY_MODE PRE_TEST TEST_LIST ${program}_timing_list
                       TEST_FILTER "*TimingTest.*" PROPERTIES RUN_SERIAL TRUE)
endfunction()

include(GoogleTest)
# scarp_options: the flags that every target of the project shares, and none of its users (ScarpInstall.cmake).
add_library(scarp_options INTERFACE)
target_compile_features(scarp_options INTERFACE cxx_std_20)
target_include_directories(scarp_options INTERFACE ${PROJECT_SOURCE_DIR}/src)
target_compile_options(scarp_options INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
# Eigen serves small dense algebra in set-up and laboratory; g++ 12 warns of its AVX-512 code for 6 × 6 matrices.
target_compile_definitions(scarp_options INTERFACE EIGEN_DONT_VECTORIZE)
# sqrt and log need not set errno: nothing here reads it, and the compiler may then use the instruction itself.
target_compile_options(scarp_options INTERFACE -fno-math-errno)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # g++ 12.2 with AVX-512 vectorizes straight-line code of double wrongly (the unit test Law.DegenerateStatesAreOrdinary
  # sees it, and passes without this pass, without AVX-512, at -O1, and with clang). Laws run in explicit batches anyway.
  target_compile_options(scarp_options INTERFACE -fno-tree-slp-vectorize)
  # Its AVX-512 intrinsics warn of themselves (GCC bug 105593); clang still checks.
  target_compile_options(scarp_options INTERFACE -Wno-uninitialized -Wno-maybe-uninitialized)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64" AND
   CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 12)
  # Copies of states in pieces as wide as a batch (no wider than the processor has): a batch that is read back from
  # narrower pieces waits for them to reach the cache. On AVX2 the subloading law takes a third less time so; on
  # AVX-512 it is g++'s own choice.
  target_compile_options(scarp_options INTERFACE -mmove-max=512 -mstore-max=512)
endif()
target_compile_options(scarp_options INTERFACE -march=${SCARP_ARCH})
if(SCARP_SHARED)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  target_compile_options(scarp_options INTERFACE -fno-semantic-interposition)  # nobody replaces functions of the library
endif()
if(SCARP_WERROR)
  target_compile_options(scarp_options INTERFACE -Werror)
endif()
if(SCARP_SANITIZE)
  target_compile_options(scarp_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  # The step's sums are written out when compiling; at -O2 with all of -g one file of them takes g++ six minutes.
  target_compile_options(scarp_options INTERFACE -O1 -g1 -fno-var-tracking)
  target_link_options(scarp_options INTERFACE -fsanitize=address,undefined)
endif()
if(SCARP_FUZZ)
  list(APPEND fuzz_sanitizers fuzzer-no-link ${SCARP_FUZZ_SANITIZE})
  list(JOIN fuzz_sanitizers "," fuzz_sanitizers)
  target_compile_options(scarp_options INTERFACE -fsanitize=${fuzz_sanitizers} -fno-sanitize-recover=all -O1 -g1)
  string(REPLACE "fuzzer-no-link" "fuzzer" fuzz_sanitizers "${fuzz_sanitizers}")
  set(SCARP_FUZZ_LINK -fsanitize=${fuzz_sanitizers})
endif()

# scarp_folder(NAME [SOURCES ...] [DEPENDS folder ...] [LINK target ...]): one target for one folder of src/scarp.
# DEPENDS names other folders, along the arrows of the architecture; LINK names libraries from outside, HEADERS those
# of them that are headers alone and in no header of the folder, so that whoever links the installed library needs none.
function(scarp_folder name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;LINK;HEADERS" ${ARGN})
  list(TRANSFORM arg_DEPENDS PREPEND scarp_)
  list(TRANSFORM arg_HEADERS REPLACE "(.+)" "$<BUILD_INTERFACE:\\1>")
  set(scope INTERFACE)
  if(arg_SOURCES)
    set(scope PUBLIC)
    add_library(scarp_${name} STATIC ${arg_SOURCES})
    target_link_libraries(scarp_${name} PUBLIC $<BUILD_INTERFACE:scarp_options> ${arg_DEPENDS} PRIVATE ${arg_LINK} ${arg_HEADERS})
  else()
    add_library(scarp_${name} INTERFACE)
    target_link_libraries(scarp_${name} INTERFACE $<BUILD_INTERFACE:scarp_options> ${arg_DEPENDS} ${arg_LINK})
  endif()
  target_compile_features(scarp_${name} ${scope} cxx_std_20)
  set_target_properties(scarp_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY SCARP_FOLDERS scarp_${name})
endfunction()

# scarp_test(NAME SOURCES ... DEPENDS folder ... [LABEL label]): one GoogleTest program, each of its tests known to ctest.
function(scarp_test name)
  cmake_parse_arguments(arg "" "LABEL" "SOURCES;DEPENDS;LINK" ${ARGN})
  list(TRANSFORM arg_DEPENDS PREPEND scarp_)
  add_executable(${name} ${arg_SOURCES})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  target_link_libraries(${name} PRIVATE ${arg_DEPENDS} ${arg_LINK} GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE SCARP_TEST_DATA="${CMAKE_CURRENT_SOURCE_DIR}")
  if(NOT arg_LABEL)
    set(arg_LABEL unit)
  endif()
  gtest_discover_tests(${name} TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS ${arg_LABEL} ENVIRONMENT OMP_WAIT_POLICY=passive)  # tests run beside each other
endfunction()

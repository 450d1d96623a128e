# SPDX-License-Identifier: BSD-3-Clause
set(tester_main "${CMAKE_CURRENT_LIST_DIR}/main.f90.in")

# A program that runs the suites of a folder, each a file test_SUITE.f90 with collect_SUITE, beside the
# other sources there; one test a suite. What is in `before_SUITE` stands before its command.
function(add_tester name folder)
  file(GLOB sources CONFIGURE_DEPENDS ${folder}/*.f90 ${folder}/*.c)
  file(GLOB suites CONFIGURE_DEPENDS ${folder}/test_*.f90)
  list(LENGTH suites number)
  set(at 0)
  foreach(suite IN LISTS suites)
    get_filename_component(suite "${suite}" NAME_WE)
    string(REGEX REPLACE "^test_" "" suite "${suite}")
    math(EXPR at "${at} + 1")
    string(APPEND uses "   use test_${suite}, only: collect_${suite}\n")
    string(APPEND made "   suites(${at}) = new_testsuite(\"${suite}\", collect_${suite})\n")
    add_test(NAME ${suite} COMMAND ${before_${suite}} $<TARGET_FILE:${name}> ${suite})
  endforeach()
  set(suites "${made}")
  configure_file("${tester_main}" "${CMAKE_CURRENT_BINARY_DIR}/${name}.f90" @ONLY)
  add_executable(${name} "${CMAKE_CURRENT_BINARY_DIR}/${name}.f90" ${sources})
  set_target_properties(${name} PROPERTIES
    Fortran_MODULE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}/${name}_modules")
endfunction()

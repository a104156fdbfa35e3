# cmake -DBUILD=folder -DWORK=folder -DBINDIR=bin -P install_test.cmake
# Installs into a folder of its own, moves that, and runs the program from elsewhere: materials must be
# found relative to the executable, not in the source tree. The source tree's are only a fallback, so the
# test asks for a material that exists in the installed folder alone.
cmake_minimum_required(VERSION 3.25)

function(run_celadon expected_output)
    execute_process(COMMAND "${WORK}/moved/${BINDIR}/celadon" ${ARGN}
        WORKING_DIRECTORY "${WORK}/elsewhere"
        RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE error)
    if(NOT result EQUAL 0 OR NOT error STREQUAL "" OR NOT output MATCHES "${expected_output}")
        message(FATAL_ERROR "celadon ${ARGN}: exit code ${result}\n${output}${error}")
    endif()
endfunction()

file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}/elsewhere")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/installed"
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "cmake --install failed\n${output}")
endif()
file(RENAME "${WORK}/installed" "${WORK}/moved")
unset(ENV{CELADON_MATERIALS})
unset(ENV{DISPLAY})

file(GLOB_RECURSE wax "${WORK}/moved/*/yellow_wax.subedit.exr")
get_filename_component(materials "${wax}" DIRECTORY)
file(COPY_FILE "${wax}" "${materials}/of_this_installation.subedit.exr")

run_celadon("128 x 128" material info yellow_wax)
run_celadon("128 x 128" material info of_this_installation)
run_celadon("" render builtin:slab --size 64x48 --irradiance-size 64 --levels 3,2 --samples 1 -o slab.png)
if(NOT EXISTS "${WORK}/elsewhere/slab.png")
    message(FATAL_ERROR "the render left no picture")
endif()
file(REMOVE_RECURSE "${WORK}")

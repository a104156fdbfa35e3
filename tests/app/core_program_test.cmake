# cmake -DCORE=build/core -DPROGRAM=celadon -DWORK=folder -P core_program_test.cmake
# The small program for a bare machine, from a folder that it was carried to: it needs nothing beyond the C
# library and what lies beside it; its backends agree; its frame is that of the full program.
cmake_minimum_required(VERSION 3.25)

function(run)
    execute_process(COMMAND ${ARGN} WORKING_DIRECTORY "${WORK}"
        RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE error)
    if(NOT result EQUAL 0)
        message(FATAL_ERROR "${ARGN}: exit code ${result}\n${output}${error}")
    endif()
    set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
file(COPY "${CORE}" DESTINATION "${WORK}")
set(core "${WORK}/core/celadon-core")

run(ldd "${core}")
string(REPLACE "\n" ";" lines "${output}")
foreach(line IN LISTS lines)
    if(line MATCHES "^[ \t]*$" OR line MATCHES "linux-vdso|ld-linux|/lib(c|m|dl|pthread|rt)\\.so"
       OR line MATCHES "=> ${WORK}/core/")
        continue()
    endif()
    message(FATAL_ERROR "celadon-core needs more than it carries: ${line}")
endforeach()

# The picture of a sharply painted material, by both backends of a GPU.
set(size 48x36)
run("${core}" bench --model sphere --material marble_chessboard --size ${size} --repeats 1
    --irradiance-size 96 --pictures pictures -o bench.json)
file(READ "${WORK}/bench.json" json)
string(JSON count LENGTH "${json}" runs)
math(EXPR last "${count} - 1")
set(compared 0)
foreach(i RANGE ${last})
    string(JSON pairs GET "${json}" runs ${i} pairs)
    if(NOT pairs GREATER 1000)
        message(FATAL_ERROR "run ${i}: ${pairs} pairs")
    endif()
    string(JSON backend GET "${json}" runs ${i} backend)
    if(backend STREQUAL tiled)
        string(JSON error GET "${json}" runs ${i} againstRaster relativeRmse)
        if(error GREATER 0.0001)
            message(FATAL_ERROR "run ${i} differs from raster by ${error}")
        endif()
        math(EXPR compared "${compared} + 1")
    endif()
endforeach()
if(compared LESS 3)
    message(FATAL_ERROR "only ${compared} runs of tiled were compared with raster")
endif()
foreach(material marble_chessboard)
    run("${PROGRAM}" material bake --recipe ${material} --float -o ${material}.subedit.exr)
    run("${PROGRAM}" render builtin:sphere --material ${material}.subedit.exr --diameter 100 --size ${size} --irradiance-size 96
        --light directional:-0.4,-0.5,-0.77 --backend tiled --background 0,0,0 -o ${material}.exr)
    run("${PROGRAM}" compare pictures/sphere_${material}_hierarchical_tiled_${size}.pfm ${material}.exr
        --fail-above relativeRmse=0.001)
endforeach()

# What it does not have it says.
execute_process(COMMAND "${core}" render RESULT_VARIABLE result ERROR_VARIABLE error)
if(NOT result EQUAL 2 OR NOT error MATCHES "small program")
    message(FATAL_ERROR "celadon-core render: exit code ${result}\n${error}")
endif()
file(REMOVE_RECURSE "${WORK}")

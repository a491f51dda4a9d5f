# SPDX-License-Identifier: Apache-2.0
# What every target shares: warnings, sanitizers, floating-point contract, and the one mechanism for run-time SIMD.

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)

add_library(whorl_flags INTERFACE)
# The same hair on every machine: no fused multiply-add unless the source asks for it, no reordering.
# -fno-math-errno and -fno-trapping-math change no result; they let loops with sqrt and conditions become vectors.
target_compile_options(whorl_flags INTERFACE -ffp-contract=off -fno-math-errno -fno-trapping-math -Wall -Wextra -Wshadow
    -Wnon-virtual-dtor -Wcast-align -Woverloaded-virtual -Wdouble-promotion -Wimplicit-fallthrough)
target_compile_definitions(whorl_flags INTERFACE GLM_FORCE_EXPLICIT_CTOR GLM_ENABLE_EXPERIMENTAL GLM_FORCE_XYZW_ONLY)
target_compile_definitions(whorl_flags INTERFACE QT_NO_KEYWORDS)
if(WHORL_WARNINGS_AS_ERRORS)
    target_compile_options(whorl_flags INTERFACE -Werror)
endif()
if(WHORL_SANITIZE)
    target_compile_options(whorl_flags INTERFACE -fsanitize=${WHORL_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    target_link_options(whorl_flags INTERFACE -fsanitize=${WHORL_SANITIZE})
endif()

# whorl_add_kernels(TARGET file.kernel.cpp...)
# Compiles each kernel source once per SIMD level (plain, avx2, avx512) with WHORL_SIMD_NAMESPACE set to the level's
# name. The source is written once in plain loops; core/base/simd.h picks the level at run time. Contraction stays
# off, so every level gives the same bytes.
function(whorl_add_kernels target)
    set(flags_plain "")
    set(flags_avx2 -mavx2 -mbmi2 -mprefer-vector-width=256)
    set(flags_avx512 -mavx512f -mavx512dq -mavx512bw -mavx512vl -mbmi2 -mprefer-vector-width=512)
    foreach(level plain avx2 avx512)
        set(objects ${target}_kernels_${level})
        add_library(${objects} OBJECT ${ARGN})
        target_compile_definitions(${objects} PRIVATE WHORL_SIMD_NAMESPACE=simd_${level})
        target_compile_options(${objects} PRIVATE -O3 ${flags_${level}})
        target_include_directories(${objects} PRIVATE ${CMAKE_SOURCE_DIR})
        target_link_libraries(${objects} PRIVATE whorl_flags)
        target_sources(${target} PRIVATE $<TARGET_OBJECTS:${objects}>)
    endforeach()
endfunction()

# The target fluisim::fluisim: the archive for the processor, and fluisim.h.
#
#     find_package(fluisim REQUIRED)      on a computer, with this folder's parent in CMAKE_PREFIX_PATH
#     include(fluisim/fluisim-config.cmake)     with pico-sdk, after pico_sdk_init()
#     target_link_libraries(program fluisim::fluisim)
#
# The archive follows from CMAKE_SYSTEM_PROCESSOR, PICO_PLATFORM and -mcpu, -march and -mfloat-abi in CMAKE_C_FLAGS and CMAKE_CXX_FLAGS; options
# given otherwise are not seen. FLUISIM_ARCHIVE chooses it by its name, a folder of lib/.

set(FLUISIM_ARCHIVE "" CACHE STRING "The archive of fluisim, a folder of its lib/; chosen by the processor where it is empty")

function(fluisim_choose_archive result)
    string(TOLOWER "${CMAKE_SYSTEM_PROCESSOR} ${PICO_PLATFORM} ${CMAKE_C_FLAGS} ${CMAKE_CXX_FLAGS}" known)
    set(hard OFF)
    if(known MATCHES "-mfloat-abi=hard")
        set(hard ON)
    endif()
    if(known MATCHES "riscv|rv32|hazard3|esp32[ch]")
        set(archive riscv32imc-unknown-none-elf)
    elseif(known MATCHES "cortex-m33|armv8-m\\.main|rp2350")
        set(archive thumbv7em-none-eabi)
        if(hard)
            set(archive thumbv8m.main-none-eabihf)
        endif()
    elseif(known MATCHES "cortex-m[47]|armv7e-m")
        set(archive thumbv7em-none-eabi)
        if(hard)
            set(archive thumbv7em-none-eabihf)
        endif()
    elseif(known MATCHES "cortex-m[013]|armv6s?-m|armv7-m|rp2040")
        set(archive thumbv6m-none-eabi)
    elseif(known MATCHES "x86_64|amd64" AND CMAKE_SYSTEM_NAME STREQUAL "Linux")
        set(archive x86_64-unknown-linux-gnu)
    else()
        message(FATAL_ERROR "fluisim: no archive is known for ${CMAKE_SYSTEM_NAME} on '${known}': set FLUISIM_ARCHIVE to a folder of "
            "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/lib")
    endif()
    set(${result} ${archive} PARENT_SCOPE)
endfunction()

if(NOT TARGET fluisim::fluisim)
    set(fluisim_archive "${FLUISIM_ARCHIVE}")
    if(NOT fluisim_archive)
        fluisim_choose_archive(fluisim_archive)
    endif()
    set(fluisim_library "${CMAKE_CURRENT_LIST_DIR}/lib/${fluisim_archive}/libfluisim.a")
    if(NOT EXISTS "${fluisim_library}")
        message(FATAL_ERROR "fluisim: there is no ${fluisim_library}")
    endif()
    message(STATUS "fluisim: ${fluisim_archive}")
    add_library(fluisim::fluisim STATIC IMPORTED GLOBAL)
    set_target_properties(fluisim::fluisim PROPERTIES
        IMPORTED_LOCATION "${fluisim_library}"
        INTERFACE_INCLUDE_DIRECTORIES "${CMAKE_CURRENT_LIST_DIR}/include")
endif()

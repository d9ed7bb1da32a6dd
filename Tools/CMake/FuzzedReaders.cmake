# What shows libFuzzer which way an input takes, in what reads files and in what a restart file fills: a library of
# its own, PendularReaders, of which PendularKernel has the objects. The whole kernel would make the tests of the same
# build slower. Not by -fsanitize=fuzzer-no-link, which precompiled headers do not bear.

set(coverage -fsanitize-coverage=inline-8bit-counters,indirect-calls,trace-cmp,pc-table)
set(readerSources ${kernelSources})
list(FILTER readerSources INCLUDE REGEX "/Kernel/(Foundation/(Files|State)/|Laws/|Core/(Particles|Walls|Run)/|Features/|Scene/|Analysis/Output/|Analysis/CoarseGraining/FieldImage)")
list(FILTER readerSources EXCLUDE REGEX "/BridgeChoice|/Adhesion/|/LiquidBridges/")
list(REMOVE_ITEM coreSources ${readerSources})
list(REMOVE_ITEM otherSources ${readerSources})
add_kernel_library(PendularReaders OBJECT ${readerSources})
target_compile_options(PendularReaders PRIVATE ${coverage})

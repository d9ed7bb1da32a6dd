#!/usr/bin/env bash
# Prints one line for the head of a table of results: machine, compiler, date.
echo "# machine: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(getconf _NPROCESSORS_ONLN) cores; compiler: $(c++ --version | head -1); date: $(date +%F)"

#!/usr/bin/env bash
# Prints the head of a table of results: a line with machine, compiler and date, and one with the command.
#   Tools/describe-machine.sh COMMAND
echo "# machine: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), $(getconf _NPROCESSORS_ONLN) cores; compiler: $(c++ --version | head -1); date: $(date +%F)"
echo "# command: $1"

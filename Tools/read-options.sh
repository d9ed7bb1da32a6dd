# For scripts, which source this file. --help prints the comment at the head of the script; what is wrong ends it with
# one sentence and exit code 2.

refuse() { echo "${0##*/}: $1" >&2; exit 2; }
print_head() { sed -n '2,${/^#/!q;s/^# \{0,1\}//p}' "$0"; }
# A program that has been built: require_program PATH
require_program() { [[ -f $1 && -x $1 ]] || refuse "there is no program $1; build it first, or give its folder with --build"; }
# A whole number above 0, in decimal digits: require_number NAME VALUE
require_number() { [[ $2 =~ ^[1-9][0-9]{0,17}$ ]] || refuse "--$1 is '$2'; it must be a whole number above 0"; }
# A file that can be read, or none given: require_file NAME PATH
require_file() { [[ -z $2 || ( -f $2 && -r $2 ) ]] || refuse "--$1 is '$2'; there is no such file that can be read"; }
# Of a script with one argument that is no option: --help, and a refusal of any other option.
read_argument() {
    case ${1:-} in
        -h | --help) print_head; exit 0 ;;
        -*) refuse "there is no option $1; see --help" ;;
    esac
}
# The options, each with a value, into variables of their names (--drum-walls into drum_walls):
#   read_options NAME... -- "$@"
read_options() {
    local known=() option
    while [[ $1 != -- ]]; do known+=("--$1"); shift; done
    shift
    while (($# > 0)); do
        if [[ $1 == --help || $1 == -h ]]; then print_head; exit 0; fi
        for option in "${known[@]}" ""; do [[ $option != "$1" ]] || break; done
        if [[ -z $option ]]; then refuse "there is no option $1; see --help"; fi
        if (($# < 2)) || [[ $2 == --* ]]; then refuse "$1 needs a value; see --help"; fi
        option=${option#--}
        printf -v "${option//-/_}" %s "$2"
        shift 2
    done
}

# What grains wear off the faces of a drum with lifters over the turns, by Archard's law.
#   gnuplot -c Drivers/WornDrum/plot.gp FOLDER    FOLDER: the driver's --output; writes FOLDER/wear.png
if (ARGC < 1) exit error "give FOLDER"
load system("dirname '".ARG0."'")."/../Shared/chart.gp"
worn = ARG1."/worn.csv"
set output ARG1."/wear.png"
set xlabel "turns"
set ylabel "volume worn off ({/Symbol m}m^3)"
set key top left
plot worn using "turns":(1e18 * column("shell_m3")) with lines linestyle 4 title "shell", \
     worn using "turns":(1e18 * column("leading_m3")) with lines linestyle 1 title "leading faces of the lifters", \
     worn using "turns":(1e18 * column("tops_m3")) with lines linestyle 2 title "tops", \
     worn using "turns":(1e18 * column("trailing_m3")) with lines linestyle 3 title "trailing faces"

# How high the wheel is, and how far it has gone round.
set terminal svg size 720,600 font "sans,13" background "white" noenhanced
set output "out/wheel.svg"
set datafile separator ","
set grid lc rgb "#dddddd"
set multiplot layout 2,1
set xlabel "t [s]"
set ylabel "above the pivot [deg]"
set key outside right
names = "given let_go pushed"
plot for [name in names] "out/".name.".csv" using "t[s]":(asin(column("links/wheel/z[m]") / 0.1) * 180 / pi) with lines lw 2 title name
set ylabel "round [deg]"
plot for [name in names] "out/".name.".csv" using "t[s]":(atan2(column("links/wheel/y[m]"), column("links/wheel/x[m]")) * 180 / pi) with points pt 7 ps 0.25 title name

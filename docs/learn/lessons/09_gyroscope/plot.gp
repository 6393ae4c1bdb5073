# Elevation and azimuth of the wheel.
set terminal svg size 720,600 font "sans,13" background "white" noenhanced
set output "out/wheel.svg"
set datafile separator ","
set grid lc rgb "#dddddd"
set multiplot layout 2,1
set xlabel "t [s]"
set ylabel "elevation [deg]"
set key outside right
names = "given let_go pushed"
start(name) = name eq "given" ? "precession rate" : name eq "let_go" ? "at rest" : name
plot for [name in names] "out/".name.".csv" using "t[s]":(asin(column("links/wheel/z[m]") / 0.1) * 180 / pi) with lines lw 2 title start(name)
set ylabel "azimuth [deg]"
plot for [name in names] "out/".name.".csv" using "t[s]":(atan2(column("links/wheel/y[m]"), column("links/wheel/x[m]")) * 180 / pi) with points pt 7 ps 0.25 title start(name)

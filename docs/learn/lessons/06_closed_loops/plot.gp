# Position of the piston over the crank's angle, with the closed form; height of the four-bar's corner.
set terminal svg size 700,620 font "sans,13" background "white"
set output "out/loops.svg"
set datafile separator ","
set grid lc rgb "#dddddd"
set multiplot layout 2,1
set xlabel "crank [deg]"
set ylabel "piston [m]"
set key top right
piston(deg) = 0.1 * cos(deg * pi / 180) + sqrt(0.09 - (0.1 * sin(deg * pi / 180))**2)
plot [-190:10] "out/engine.csv" using (column("q/crank[rad]") * 180 / pi):(column("links/piston/x[m]")) with points pt 7 ps 0.25 lc 7 title "run", \
     piston(x) lc 6 title "by hand"
set xlabel "t [s]"
set ylabel "upper left corner, height [m]"
plot "out/four_bar.csv" using "t[s]":(column("links/beam0/z[m]")) with lines lw 2 lc 6 notitle

# Vertical component of the stem's direction: z component of the body's x axis, from the quaternion.
set terminal svg size 720,380 font "sans,13" background "white"
set output "out/stem.svg"
set datafile separator ","
set grid lc rgb "#dddddd"
set key outside top center horizontal
set xlabel "t [s]"
set ylabel "vertical component of the stem"
set yrange [-1.1:1.1]
up(w, x, y, z) = 2 * (x * z - w * y)
plot for [aside in "0.01 0.001 0"] "out/aside_".aside.".csv" using "t[s]":(up(column("q/base/turn_w[1]"), column("q/base/turn_x[1]"), column("q/base/turn_y[1]"), column("q/base/turn_z[1]"))) with lines lw 2 title aside." rad/s beside"

local h = history.piecewise{ times = { 0, 1*us, 2*us }, values = { 0, 1 } }

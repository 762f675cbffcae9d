local h = history.step{ value = 1, at = -1*us }

local code = string.dump(print)

// expect: undeclared
int main() {
    return undeclared_1 + undeclared_2 + undeclared_3;
}
